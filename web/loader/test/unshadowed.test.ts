import { describe, expect, it } from 'vitest';

import { darkness, relight } from '../src/index.js';
import { computeUnshadowed, makeUnshadowedLayer } from '../src/relight/unshadowed.js';
import { shIndex } from '../src/sh/sh.js';

// Of floats, whose sum is of magnitude 1.
const kRounding = 1e-6;

describe('unshadowed transport', () => {
    const normals = new Float32Array([0, 1, 0, 0.6, -0.8, 0, 0.36, 0.48, 0.8, -1, 0, 0]);

    it.each([1, 2, 3, 5, 10])('of %i bands reflects light that grows linearly along y as a closed form says', (bandCount) => {
        // L(ω) = a + b y. A_0 = π and A_1 = 2π/3, so that B = a + 2/3 b n_y.
        const [a, b] = [0.7, bandCount > 1 ? 0.6 : 0];
        const lighting = darkness(bandCount);
        for (let channel = 0; channel < 3; ++channel) {
            lighting.coefficients[channel] = (channel + 1) * a * Math.sqrt(4 * Math.PI);
            if (bandCount > 1) lighting.coefficients[3 * shIndex(1, -1) + channel] = -(channel + 1) * b * Math.sqrt((4 * Math.PI) / 3);
        }
        const layer = makeUnshadowedLayer(bandCount);
        const radiance = relight(layer, computeUnshadowed(layer, normals), lighting);
        expect(radiance.length).toBe(normals.length);
        radiance.forEach((value, i) => {
            const y = normals[3 * Math.floor(i / 3) + 1];
            expect(Math.abs(value - ((i % 3) + 1) * (a + (2 / 3) * b * y))).toBeLessThan(3 * kRounding);
        });
    });
});
