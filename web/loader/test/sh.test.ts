import { describe, expect, it } from 'vitest';

import { rotationXyz, transform } from '../src/math.js';
import { discLighting, sunDirection, sunLighting, uniformLighting } from '../src/sh/analytic_lights.js';
import { clampedCosineFactors, deringingFactors } from '../src/sh/deringing.js';
import { addLighting, applyWindow, darkness, parseLighting, reconstruct, scaleLighting, toThreeProbe, withBands } from '../src/sh/lighting.js';
import { projectLatLong } from '../src/sh/project_lat_long.js';
import { rotateLighting } from '../src/sh/rotate.js';
import { evaluateSh } from '../src/sh/sh.js';
import { windowFactors } from '../src/sh/window.js';
import { largestDifference, lightDifference, lightOf, vectors } from './support/vectors.js';

// Doubles on both sides; up to 19 factors are multiplied, and coefficients are of magnitude 1 to 10.
const kRounding = 1e-12;
// λ is found to the eighth digit, for the lowest point is.
const kDeringing = 1e-7;

describe('the basis', () => {
    it('has the values of docs/format.md', () => {
        const root = Math.sqrt(14);
        const expected = [0.282094792, -0.261169028, 0.391753542, -0.130584514, 0.156078347, -0.468235042, 0.292863596, -0.234117521, -0.117058760];
        expect(largestDifference(evaluateSh([1 / root, 2 / root, 3 / root], 3), expected)).toBeLessThan(1e-9);
    });

    it.each(vectors.bases)('has the values of the library at $direction', ({ direction, values }: any) =>
        expect(largestDifference(evaluateSh(direction, 10), values)).toBeLessThan(kRounding));
});

describe('rotation', () => {
    it.each(vectors.rotations)('gives the coefficients of the library by $matrix', ({ matrix, lighting, rotated }: any) =>
        expect(lightDifference(rotateLighting(lightOf(lighting), matrix), lightOf(rotated))).toBeLessThan(kRounding));

    it('takes the light from where it comes to where that is turned', () => {
        const rotation = rotationXyz(20, -50, 170);
        const from = sunDirection(30, 40);
        const turned = rotateLighting(sunLighting(from, 0.1, 10), rotation);
        expect(lightDifference(turned, sunLighting(transform(rotation, from), 0.1, 10))).toBeLessThan(kRounding);
        expect(transform(rotationXyz(0, 0, 90), [1, 0, 0])[1]).toBeCloseTo(1, 14);
        expect(transform(rotationXyz(90, 0, 90), [0, 1, 0])[2]).toBeCloseTo(1, 14);
    });
});

describe('lights', () => {
    it.each(vectors.suns)('a sun of $angleDegrees degrees is that of the library', ({ azimuthDegrees, elevationDegrees, angleDegrees, lighting }: any) => {
        const sun = sunLighting(sunDirection(azimuthDegrees, elevationDegrees), (angleDegrees * Math.PI) / 360, 10);
        expect(lightDifference(sun, lightOf(lighting))).toBeLessThan(1e-9); // 1 − cos α of half a degree has ten digits
    });

    it('a disc that is the whole sphere is the same from everywhere', () =>
        expect(lightDifference(discLighting([0, 0, 1], Math.PI, [1, 2, 3], 5), uniformLighting([1, 2, 3], 5))).toBeLessThan(kRounding));

    it('add, scale, lose bands, and stand for radiance', () => {
        const sum = addLighting(uniformLighting([1, 2, 3], 2), scaleLighting(uniformLighting([1, 1, 1], 4), [0.5, 0.5, 1]));
        expect(sum.bandCount).toBe(4);
        expect(largestDifference(reconstruct(sum, [0, 0.6, 0.8]), [1.5, 2.5, 4])).toBeLessThan(kRounding);
        expect(withBands(withBands(sum, 1), 3).coefficients.length).toBe(27);
        expect(toThreeProbe(sunLighting([0, 1, 0], 0, 3))[1][0]).toBeCloseTo(0.4886025, 6);
    });

    it.each([
        [null], [{}], [{ bands: 2, convention: 'rh', coefficients: [] }], [{ bands: 2, convention: 'cs', coefficients: [[1, 2, 3]] }],
        [{ bands: 1, convention: 'cs', coefficients: [[1, 2, null]] }], [{ bands: 1e9, convention: 'cs', coefficients: [] }],
    ])('%j is none', (json) => expect(() => parseLighting(json)).toThrow('the coefficients of a light'));
});

describe('an environment', () => {
    it.each(vectors.projections)('of $width by $height has the coefficients of the library', ({ width, height, texels, lighting }: any) => {
        const expected = lightOf(lighting);
        expect(lightDifference(projectLatLong({ width, height, data: texels, channelCount: 3 }, expected.bandCount), expected)).toBeLessThan(kRounding);
    });

    it('may stand on its head and have alpha', () => {
        const data = Float32Array.from({ length: 8 * 4 * 4 }, (_, i) => (i * 7919) % 31);
        const rows = [3, 2, 1, 0].map((row) => data.subarray(row * 32, row * 32 + 32));
        const flipped = Float32Array.from(rows.flatMap((row) => [...row]));
        const straight = projectLatLong({ width: 8, height: 4, data, channelCount: 4 }, 4);
        expect(lightDifference(projectLatLong({ width: 8, height: 4, data: flipped, channelCount: 4, isUpsideDown: true }, 4), straight)).toBe(0);
    });

    it('that is not finite is refused', () =>
        expect(() => projectLatLong({ width: 1, height: 1, data: [1, NaN, 1], channelCount: 3 }, 2)).toThrow('finite'));
});

describe('windows', () => {
    it.each(vectors.windows)('of $bands bands are those of the library', ({ bands, hann, lanczos }: any) => {
        expect(largestDifference(windowFactors('hann', bands), hann)).toBeLessThan(kRounding);
        expect(largestDifference(windowFactors('lanczos', bands), lanczos)).toBeLessThan(kRounding);
        expect(windowFactors('none', bands)).toEqual(new Float64Array(bands).fill(1));
    });

    it('multiply each band by its factor', () => {
        const light = { ...darkness(3), coefficients: new Float64Array(27).fill(1) };
        const { coefficients } = applyWindow(light, [1, 2, 3]);
        expect([coefficients[2], coefficients[3], coefficients[11], coefficients[12], coefficients[26]]).toEqual([1, 2, 2, 3, 3]);
    });

    it('the clamped cosine has its closed form', () =>
        expect(largestDifference(clampedCosineFactors(7), [Math.PI, (2 * Math.PI) / 3, Math.PI / 4, 0, -Math.PI / 24, 0, Math.PI / 64])).toBeLessThan(kRounding));

    it.each(vectors.deringing)('against ringing are those of the library', ({ lighting, radiance, irradiance }: any) => {
        expect(largestDifference(deringingFactors(lightOf(lighting), 'radiance'), radiance)).toBeLessThan(kDeringing);
        expect(largestDifference(deringingFactors(lightOf(lighting), 'irradiance'), irradiance)).toBeLessThan(kDeringing);
    });
});
