import { type DataTexture, DataUtils, HalfFloatType, RGBAFormat, RGBFormat } from 'three';

import { OpenPrtError } from '../error.js';
import type { Lighting } from './lighting.js';
import { type LatLongImage, projectLatLong } from './project_lat_long.js';

/**
 * Projects an environment that three.js loaded, as HDRLoader and EXRLoader do: a lat-long picture of linear radiance, in floats or halves.
 * HDRLoader makes it 256/255 as bright as it is: it divides mantissas by 255.
 *
 * @param texture  with its image still in memory, of three or four channels
 */
export function projectTexture(texture: DataTexture, bandCount: number): Lighting {
    return projectLatLong(latLongImageOf(texture), bandCount);
}

/** Three.js's textures have their first row at the bottom, unless they are flipped as they are sent to the GPU. */
function latLongImageOf({ image, type, format, flipY }: DataTexture): LatLongImage {
    const channelCount = format === RGBAFormat ? 4 : format === RGBFormat ? 3 : 0;
    const data = image.data as ArrayLike<number> | null;
    if (channelCount === 0 || !data) throw new OpenPrtError('invalidOption', 'an environment must be a texture of red, green and blue, with its data');
    const isHalf = type === HalfFloatType;
    if (!isHalf && !(data instanceof Float32Array)) throw new OpenPrtError('invalidOption', 'an environment must be of floats or halves, which are linear');
    const numbers = isHalf ? Float32Array.from(data, (half) => DataUtils.fromHalfFloat(half)) : data;
    return { width: image.width, height: image.height, data: numbers, channelCount, isUpsideDown: !flipY };
}
