// Bibliography
//   [Ramamoorthi01]  An efficient representation for irradiance environment maps
import type { Layer } from '../asset/layer.js';
import { clampedCosineFactors } from '../sh/deringing.js';
import { evaluateSh } from '../sh/sh.js';

/** The layer that an asset need not store, since normals tell it: floats of one channel. */
export function makeUnshadowedLayer(bandCount: number): Layer {
    const coefficientCount = bandCount ** 2;
    return {
        transport: 'unshadowed',
        channelCount: 1,
        incidentBandCount: 0,
        coefficientCount,
        numberCount: coefficientCount,
        firstAttribute: 0,
        attributeCount: Math.ceil(coefficientCount / 4),
        storage: { encoding: 'float32', scale: new Float32Array(0), bias: new Float32Array(0) },
        largestError: 0,
    };
}

/**
 * What a primitive would store of it: transfer of surfaces that nothing shadows.
 *
 *   T_lm = (A_l / π) y_lm(n)                                            [Ramamoorthi01, eq. 7]
 *
 * @param normals  x, y, z of each vertex; unit but for rounding
 */
export function computeUnshadowed(layer: Layer, normals: Float32Array): Float32Array {
    const bandCount = Math.sqrt(layer.coefficientCount);
    const factors = clampedCosineFactors(bandCount).map((factor) => factor / Math.PI);
    const bands = Array.from({ length: layer.coefficientCount }, (_, i) => Math.floor(Math.sqrt(i)));
    const width = 4 * layer.attributeCount;
    const numbers = new Float32Array((normals.length / 3) * width);
    const values = new Float64Array(layer.coefficientCount);
    for (let from = 0, to = 0; from < normals.length; from += 3, to += width) {
        evaluateSh([normals[from], normals[from + 1], normals[from + 2]], bandCount, values);
        for (let i = 0; i < values.length; ++i) numbers[to + i] = factors[bands[i]] * values[i];
    }
    return numbers;
}
