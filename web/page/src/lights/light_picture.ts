import { type Lighting, type Vec3, applyWindow, reconstruct, windowFactors } from 'openprt-three';
import { ClampToEdgeWrapping, DataTexture, DataUtils, HalfFloatType, LinearFilter, RGBAFormat, RepeatWrapping } from 'three';

/** What a light looks like, small: lat-long (C4), rows from the top, linear radiance in half floats, four a texel. */
export interface LightPicture {
    width: number;
    height: number;
    texels: Uint16Array<ArrayBuffer>;
}

const kLargestHalf = 65504;
const kMadeHeight = 64;

/** @param bytes  what `prt web` stores: three half floats a texel, little endian, as every browser's machine is */
export function readPicture(bytes: Uint8Array<ArrayBuffer>, width: number, height: number): LightPicture {
    const halves = new Uint16Array(bytes.buffer, bytes.byteOffset, 3 * width * height);
    const texels = new Uint16Array(4 * width * height);
    for (let i = 0; i < width * height; ++i) texels.set(halves.subarray(3 * i, 3 * i + 3), 4 * i);
    return { width, height, texels };
}

/** A picture of what `radianceAt` tells of each texel. */
export function makePicture(width: number, height: number, radianceAt: (column: number, row: number) => Vec3): LightPicture {
    const texels = new Uint16Array(4 * width * height);
    for (let row = 0; row < height; ++row)
        for (let column = 0; column < width; ++column)
            radianceAt(column, row).forEach((value, channel) => {
                texels[4 * (row * width + column) + channel] = DataUtils.toHalfFloat(Math.min(Math.max(value, 0), kLargestHalf));
            });
    return { width, height, texels };
}

/** The direction of the centre of a texel (C4), of a lat-long picture twice as wide as high. */
export function directionOf(column: number, row: number, height: number): Vec3 {
    const theta = (Math.PI * (row + 0.5)) / height;
    const azimuth = (Math.PI * (column + 0.5)) / height - Math.PI;
    return [Math.sin(theta) * Math.cos(azimuth), Math.cos(theta), Math.sin(theta) * Math.sin(azimuth)];
}

/** Of a light of which there are only coefficients, without their ringing. */
export function pictureOfCoefficients(lighting: Lighting): LightPicture {
    const smooth = applyWindow(lighting, windowFactors('hann', lighting.bandCount));
    return makePicture(2 * kMadeHeight, kMadeHeight, (column, row) => reconstruct(smooth, directionOf(column, row, kMadeHeight)));
}

/** Radiance of a texel. */
export function radianceOf({ width, texels }: LightPicture, column: number, row: number): [number, number, number] {
    const first = 4 * (row * width + column);
    return [0, 1, 2].map((channel) => DataUtils.fromHalfFloat(texels[first + channel])) as [number, number, number];
}

/** For a shader: v goes down from the top. */
export function makePictureTexture({ width, height, texels }: LightPicture): DataTexture {
    const texture = new DataTexture(texels, width, height, RGBAFormat, HalfFloatType, undefined, RepeatWrapping, ClampToEdgeWrapping, LinearFilter, LinearFilter);
    texture.needsUpdate = true;
    return texture;
}
