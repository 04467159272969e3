import { DataTexture, FloatType, RGBAFormat, RGBAIntegerFormat, UnsignedByteType, UnsignedShortType } from 'three';

import type { Layer, StoredArray } from '../asset/layer.js';
import { textureSideFor } from './layer_light.js';

/** What a primitive stores of a layer, as stored: texel `vertex · attributes.length + slot` holds four numbers. */
export function makeTransferTexture(layer: Layer, numbers: StoredArray, attributes: readonly number[]): DataTexture {
    const { attributeCount, storage } = layer;
    const vertexCount = numbers.length / (4 * attributeCount);
    const texelCount = vertexCount * attributes.length;
    const side = textureSideFor(texelCount);
    const texels = new (numbers.constructor as new (length: number) => StoredArray)(4 * side * Math.ceil(texelCount / side));
    for (let vertex = 0, to = 0; vertex < vertexCount; ++vertex)
        for (const attribute of attributes) {
            const from = 4 * (vertex * attributeCount + attribute);
            for (let k = 0; k < 4; ++k) texels[to++] = numbers[from + k];
        }
    const height = texels.length / (4 * side);
    if (storage.encoding === 'float32') return ready(new DataTexture(texels, side, height, RGBAFormat, FloatType));
    const type = storage.encoding === 'unorm16' ? UnsignedShortType : UnsignedByteType;
    return ready(new DataTexture(texels, side, height, RGBAIntegerFormat, type));
}

function ready(texture: DataTexture): DataTexture {
    texture.needsUpdate = true;
    return texture;
}
