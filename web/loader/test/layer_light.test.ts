import type { Vector3 } from 'three';
import { expect, it } from 'vitest';

import type { Layer } from '../src/asset/layer.js';
import { diffuseRow } from '../src/relight/folded_light.js';
import { LayerLight } from '../src/relight/layer_light.js';
import { relight } from '../src/relight/relight.js';
import { makeTransferTexture } from '../src/relight/transfer_texture.js';
import { largestDifference } from './support/vectors.js';

const kVertexCount = 3;
const number = (k: number): number => ((k * 7919) % 251) / 251;

function makeLayer(channelCount: 1 | 3, bandCount: number, incidentBandCount: number): Layer {
    const coefficientCount = channelCount * bandCount ** 2 * Math.max(1, incidentBandCount ** 2);
    return {
        transport: incidentBandCount ? 'glossy' : 'interreflected', channelCount, incidentBandCount, coefficientCount, numberCount: coefficientCount,
        firstAttribute: 0, attributeCount: Math.ceil(coefficientCount / 4), largestError: 0,
        storage: { encoding: 'unorm8', scale: Float32Array.from({ length: coefficientCount }, (_, k) => number(k) + 0.1), bias: Float32Array.from({ length: coefficientCount }, (_, k) => number(k + 5) - 0.5) },
    };
}

// Channels may share four numbers, and a row of a matrix may begin and end within them.
it.each([[1, 1, 0], [1, 3, 0], [3, 1, 0], [3, 3, 0], [3, 5, 0], [1, 10, 0], [3, 9, 0], [3, 10, 0], [1, 3, 3], [3, 3, 2], [3, 5, 3]] as const)(
    '%d channels of %d bands with %d incident bands are summed from four numbers at a time as one by one, within the uniforms of any WebGL2',
    (channelCount, bandCount, incidentBandCount) => {
        const layer = makeLayer(channelCount, bandCount, incidentBandCount);
        const width = 4 * layer.attributeCount;
        const numbers = Uint8Array.from({ length: width * kVertexCount }, (_, k) => (k % width < layer.numberCount ? 255 * number(k) : 0));
        const lighting = { bandCount, coefficients: Float64Array.from({ length: 3 * bandCount ** 2 }, (_, k) => number(3 * k) - 0.3) };
        const light = new LayerLight(layer, diffuseRow(layer)!);
        light.set(lighting);
        const texels = makeTransferTexture(layer, numbers, light.attributes).image.data as Uint8Array;
        const weights = light.uniforms.prtWeights.value as Float32Array;
        expect(weights.length / 4).toBeLessThanOrEqual(80);
        const sums = Array.from({ length: kVertexCount }, (_, vertex) => {
            const sum = (light.uniforms.prtConstant.value as Vector3).toArray();
            light.terms.forEach(({ slot, channel }, term) => {
                for (let k = 0; k < 4; ++k) sum[channel] += weights[4 * term + k] * texels[4 * (vertex * light.attributes.length + slot) + k];
            });
            return sum;
        });
        expect(largestDifference(sums.flat(), relight(layer, numbers, lighting))).toBeLessThan(1e-5);
    },
);
