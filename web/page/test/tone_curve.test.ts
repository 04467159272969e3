import { ShaderChunk } from 'three';
import { describe, expect, it } from 'vitest';

import { applyToneCurve, encodeSrgb8, kToneCurves } from '../src/picture/tone_curve.js';

describe('tone curves', () => {
    it('none clamps', () => {
        expect(applyToneCurve('none', [-1, 0.25, 3])).toEqual([0, 0.25, 1]);
    });

    it('aces has the values of its formula', () => {
        // 0.18: 0.18 (2.51 · 0.18 + 0.03) / (0.18 (2.43 · 0.18 + 0.59) + 0.14); at 1: 2.54 / 3.16
        const [grey, one, much] = applyToneCurve('aces', [0.18, 1, 1e30]);
        expect(grey).toBeCloseTo(0.086724 / 0.324932, 12);
        expect(one).toBeCloseTo(2.54 / 3.16, 12);
        expect(much).toBe(1);
    });

    it('neutral leaves greys below its shoulder as they are, but for the reflection of 4 %', () => {
        applyToneCurve('neutral', [0.5, 0.5, 0.5]).forEach((value) => expect(value).toBeCloseTo(0.46, 12));
        applyToneCurve('neutral', [0.04, 0.04, 0.04]).forEach((value) => expect(value).toBeCloseTo(0.04 - (0.04 - 0.04 ** 2 / 0.16), 12));
    });

    it('neutral brings what is bright below 1, and whiter', () => {
        const [red, green, blue] = applyToneCurve('neutral', [10, 1, 1]);
        expect(red).toBeGreaterThan(green);
        expect(red).toBeLessThan(1);
        expect(green).toBe(blue);
        expect(green / red).toBeGreaterThan(0.1);
    });

    it.each(kToneCurves)('%s never falls', (curve) => {
        let before = -1;
        for (let radiance = 0; radiance < 20; radiance += 0.01) {
            const [shown] = applyToneCurve(curve, [radiance, radiance, radiance]);
            expect(shown).toBeGreaterThanOrEqual(before);
            before = shown;
        }
    });

    it("ours stands where three.js leaves room for it", () => {
        expect(ShaderChunk.tonemapping_pars_fragment).toContain('( 2.43 * x + 0.59 )');
    });

    it('sRGB has the code values of its standard', () => {
        expect([0, 0.0031308, 0.21586, 0.5, 1].map(encodeSrgb8)).toEqual([0, 10, 128, 188, 255]);
    });
});
