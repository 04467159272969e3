import { addLighting, discLighting, rotateLighting, rotationXyz, scaleLighting, sunDirection, uniformLighting } from 'openprt-three';
import { describe, expect, it } from 'vitest';

import { chooseExposure } from '../src/lights/exposure.js';

// Normals stand some degrees apart, at which a lobe of three bands has lost less.
const kGrid = 2e-3;

describe('the exposure that is chosen', () => {
    it.each([1, 3, 5])('shows a white surface under light from everywhere as 0.8, of %d bands', (bandCount) => {
        expect(chooseExposure(uniformLighting([4, 4, 4], bandCount))).toBeCloseTo(Math.log2(0.8 / 4), 10);
    });

    it('weighs the channels as luminance does', () => {
        expect(chooseExposure(uniformLighting([0, 2, 0], 3))).toBeCloseTo(Math.log2(0.8 / (2 * 0.7152)), 10);
    });

    it('of light 1 from half of all directions is that of the side that faces it', () => {
        // Its first three bands: the mean ½, ¾ cos θ of radiance and of P_2 none.
        const light = discLighting(sunDirection(20, 30), Math.PI / 2, [1, 1, 1], 6);
        expect(Math.abs(chooseExposure(light) - Math.log2(0.8))).toBeLessThan(kGrid);
    });

    it('is as much less as the light is more', () => {
        const light = addLighting(uniformLighting([1, 2, 3], 5), discLighting([0, 1, 0], 0.3, [9, 8, 7], 5));
        expect(chooseExposure(scaleLighting(light, [8, 8, 8]))).toBeCloseTo(chooseExposure(light) - 3, 10);
    });

    it('stays as the light turns', () => {
        const light = discLighting([0.6, 0.8, 0], 0.2, [50, 40, 30], 5);
        const turned = rotateLighting(light, rotationXyz(30, 70, 0));
        expect(Math.abs(chooseExposure(turned) - chooseExposure(light))).toBeLessThan(kGrid);
    });

    it('of no light changes nothing', () => {
        expect(chooseExposure(uniformLighting([0, 0, 0], 3))).toBe(0);
    });
});
