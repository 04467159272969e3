import { describe, expect, it } from 'vitest';

import { type Vec3, gaussLegendre, tangentFrame, transform, transpose } from '../src/math.js';
import { makeLobeTable } from '../src/relight/gltf_lobes.js';
import { reflect } from '../src/relight/reflect.js';
import { evaluateSh } from '../src/sh/sh.js';

const kBandCount = 5;

/** l_i of radiance over the upper hemisphere, 0 below. */
function receive(radianceOf: (direction: Vec3) => number): Float32Array {
    const incident = new Float32Array(3 * kBandCount ** 2);
    const { nodes, weights } = gaussLegendre(24);
    nodes.forEach((node, i) => {
        for (let k = 0; k < 48; ++k) {
            const z = (node + 1) / 2;
            const phi = (2 * Math.PI * k) / 48;
            const sine = Math.sqrt(1 - z * z);
            const direction: Vec3 = [sine * Math.cos(phi), sine * Math.sin(phi), z];
            const weight = ((weights[i] / 2) * 2 * Math.PI * radianceOf(direction)) / 48;
            evaluateSh(direction, kBandCount).forEach((value, j) => {
                for (let channel = 0; channel < 3; ++channel) incident[3 * j + channel] += weight * value;
            });
        }
    });
    return incident;
}

/** The reflected radiance itself: the integral of glTF's BRDF, by midpoints over the hemisphere. */
function reflectSlowly(radianceOf: (direction: Vec3) => number, wo: Vec3, roughness: number, metallic: number, baseColor: number): number {
    const alpha2 = roughness ** 4;
    const f0 = 0.04 * (1 - metallic) + baseColor * metallic;
    let sum = 0;
    const [rows, columns] = [240, 480];
    for (let row = 0; row < rows; ++row)
        for (let column = 0; column < columns; ++column) {
            const theta = ((row + 0.5) / rows) * (Math.PI / 2);
            const phi = ((column + 0.5) / columns) * 2 * Math.PI;
            const wi: Vec3 = [Math.sin(theta) * Math.cos(phi), Math.sin(theta) * Math.sin(phi), Math.cos(theta)];
            const half = [wi[0] + wo[0], wi[1] + wo[1], wi[2] + wo[2]];
            const length = Math.hypot(...half);
            const oh = (wo[0] * half[0] + wo[1] * half[1] + wo[2] * half[2]) / length;
            const nh = half[2] / length;
            const spread = alpha2 / (Math.PI * (nh * nh * (alpha2 - 1) + 1) ** 2);
            const visibility = 0.5 / (wi[2] * Math.sqrt(wo[2] ** 2 * (1 - alpha2) + alpha2) + wo[2] * Math.sqrt(wi[2] ** 2 * (1 - alpha2) + alpha2));
            const fresnel = f0 + (1 - f0) * (1 - oh) ** 5;
            const diffuse = ((1 - metallic) * baseColor * (1 - (0.04 + 0.96 * (1 - oh) ** 5))) / Math.PI;
            sum += (fresnel * spread * visibility + diffuse) * wi[2] * radianceOf(wi) * Math.sin(theta);
        }
    return sum * (Math.PI / 2 / rows) * ((2 * Math.PI) / columns);
}

describe('reflection', () => {
    const up: Vec3 = [0, 0, 1];
    const view: Vec3 = [0.36, 0.48, 0.8];
    const light = ([x, y, z]: Vec3): number => 1 + 0.5 * x - 0.3 * y + 0.4 * z; // of few bands above the horizon

    // Five bands hold such light, cut off at the horizon, to some hundredths where lobes are wide.
    it.each([
        [1, 0, 0.8], [0.6, 0, 0.5], [0.6, 1, 0.9], [0.4, 1, 0.7],
    ])('at roughness %d and metallic %d is that of the BRDF of glTF', (roughness, metallic, baseColor) => {
        const { perBaseColor, constant } = reflect(receive(light), 0, kBandCount, up, view, makeLobeTable(roughness, kBandCount), metallic);
        const expected = reflectSlowly(light, view, roughness, metallic, baseColor);
        expect(Math.abs(baseColor * perBaseColor[1] + constant[1] - expected)).toBeLessThan(0.02 * expected);
    });

    it('at a grazing view shows even what reflects nothing straight on', () => {
        const grazing: Vec3 = [Math.sin(1.35), 0, Math.cos(1.35)];
        const { constant } = reflect(receive(light), 0, kBandCount, up, grazing, makeLobeTable(0.6, kBandCount), 1);
        const expected = reflectSlowly(light, grazing, 0.6, 1, 0);
        expect(expected).toBeGreaterThan(0.04);
        expect(Math.abs(constant[0] - expected)).toBeLessThan(0.05 * expected);
    });

    it('is of the frame that the normal has', () => {
        const lobes = makeLobeTable(0.5, kBandCount);
        const normal: Vec3 = [2 / 7, 3 / 7, -6 / 7];
        const there = transform(transpose(tangentFrame(normal)), view);
        const straight = reflect(receive(light), 0, kBandCount, up, view, lobes, 0.5);
        expect(reflect(receive(light), 0, kBandCount, normal, there, lobes, 0.5).perBaseColor[2]).toBeCloseTo(straight.perBaseColor[2], 6);
    });

    it('turns with light and view about the normal', () => {
        const lobes = makeLobeTable(0.5, kBandCount);
        const turned = reflect(receive(([x, y, z]) => light([y, -x, z])), 0, kBandCount, up, [-view[1], view[0], view[2]], lobes, 1);
        expect(turned.perBaseColor[0]).toBeCloseTo(reflect(receive(light), 0, kBandCount, up, view, lobes, 1).perBaseColor[0], 5);
    });
});
