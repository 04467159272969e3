import { describe, expect, it } from 'vitest';

import { isGlossy } from '../src/asset/layer.js';
import { readAsset } from '../src/asset/read_asset.js';
import { type Vec3, gaussLegendre, rotationXyz, tangentFrame, transform, transpose } from '../src/math.js';
import { coefficientsOf } from '../src/relight/coefficients.js';
import { receiveLight, relight } from '../src/relight/relight.js';
import { rotateLighting } from '../src/sh/rotate.js';
import { evaluateSh } from '../src/sh/sh.js';
import { goldenBytes, kEncodings, kVersions } from './support/golden.js';
import { largestDifference, lightOf, vectors } from './support/vectors.js';

// The library sums in floats; what is summed is of magnitude 1 to 10.
const kRounding = 1e-5;

describe('relit vertices', () => {
    it('are those of the library, of every golden asset', () => {
        expect(vectors.assets.map(({ file }: any) => file).sort()).toEqual(
            kVersions.flatMap((version) => kEncodings.map((encoding) => `${version}-${encoding}.prt.glb`)).sort(),
        );
    });

    it.each(vectors.assets)('$file has those of the library', ({ file, lighting, layers }: any) => {
        const [, version, encoding] = /^(.*)-(.*)\.prt\.glb$/.exec(file)!;
        const asset = readAsset(goldenBytes(version, encoding as any));
        expect(asset.header.layers.map(({ transport }) => transport)).toEqual(Object.keys(layers));
        asset.header.layers.forEach((layer, l) => {
            const compute = isGlossy(layer.transport) ? receiveLight : relight;
            const numbers = asset.primitives.flatMap((primitive) => [...compute(layer, primitive.numbers[l], lightOf(lighting))]);
            expect(largestDifference(numbers, layers[layer.transport])).toBeLessThan(kRounding);
        });
    });

    it('of matrices are row 2 of them, as diffuse surfaces have it', () => {
        const asset = readAsset(goldenBytes('1.2', 'unorm16'));
        const lighting = lightOf((vectors.assets[0] as any).lighting);
        for (const l of [2, 3]) {
            const layer = asset.header.layers[l];
            const [{ numbers, vertexCount }] = asset.primitives;
            const incident = receiveLight(layer, numbers[l], lighting);
            const rowCount = layer.incidentBandCount ** 2;
            const expected = Array.from({ length: 3 * vertexCount }, (_, k) =>
                Math.sqrt(4 / (3 * Math.PI)) * incident[3 * (Math.floor(k / 3) * rowCount + 2) + (k % 3)]);
            expect(largestDifference(relight(layer, numbers[l], lighting), expected)).toBeLessThan(1e-6);
        }
    });

    it('are the sum over the coefficients, with fewer bands of light too', () => {
        const asset = readAsset(goldenBytes('1.1', 'float32'));
        const white = { bandCount: 1, coefficients: Float64Array.from([2, 3, 4]) };
        asset.header.layers.forEach((layer, l) => {
            const numbers = asset.primitives[1].numbers[l];
            const values = coefficientsOf(layer, numbers);
            relight(layer, numbers, white).forEach((radiance, k) => {
                const channel = layer.channelCount === 1 ? 0 : k % 3;
                expect(radiance).toBeCloseTo(values[Math.floor(k / 3) * layer.coefficientCount + 4 * channel] * (2 + (k % 3)), 6);
            });
        });
    });
});

describe('the frame of a vertex', () => {
    it('is that of docs/format.md', () => {
        const scaled = (rows: number[]): number[] => rows.map((number) => number / 91);
        expect(largestDifference(tangentFrame([2 / 7, 3 / 7, 6 / 7]), scaled([87, -6, -26, -6, 82, -39, 26, 39, 78]))).toBeLessThan(1e-15);
        expect(largestDifference(tangentFrame([2 / 7, 3 / 7, -6 / 7]), scaled([87, -6, 26, 6, -82, -39, 26, 39, -78]))).toBeLessThan(1e-15);
        expect(tangentFrame([1, 0, -0])[1 + 3]).toBe(-1);
        expect(tangentFrame([1, 0, 0])[1 + 3]).toBe(1);
    });

    it.each([
        [6, [0.5, -0.185577, 0.371154, -0.123718, 0, 0.450549, 0.214286, -0.032967, 0.433013, -0.214286, 0.428571, -0.142857, 0, -0.032967, 0.142857, 0.478022]],
        [-6, [0.5, -0.185577, -0.371154, -0.123718, 0, -0.450549, 0.214286, 0.032967, 0.433013, -0.214286, -0.428571, -0.142857, 0, -0.032967, -0.142857, 0.478022]],
    ])('gives an open surface of normal (2, 3, %d)/7 the matrix of docs/format.md', (z, expected) => {
        const frame = tangentFrame([2 / 7, 3 / 7, z / 7]);
        const { nodes, weights } = gaussLegendre(4);
        const matrix = new Float64Array(16);
        for (let node = 0; node < 4; ++node)
            for (let k = 0; k < 5; ++k) {
                const height = (nodes[node] + 1) / 2;
                const phi = (2 * Math.PI * k) / 5;
                const across = Math.sqrt(1 - height * height);
                const local: Vec3 = [across * Math.cos(phi), across * Math.sin(phi), height];
                const there = evaluateSh(transform(transpose(frame), local), 2);
                evaluateSh(local, 2).forEach((y, i) => there.forEach((value, j) => (matrix[4 * i + j] += (y * value * weights[node] * Math.PI) / 5)));
            }
        expect(largestDifference(matrix, expected)).toBeLessThan(1e-6);
    });
});

it('an object that is turned is lit by the light turned the other way', () => {
    const asset = readAsset(goldenBytes('1.0', 'float32'));
    const lighting = lightOf((vectors.assets[0] as any).lighting);
    const there = rotationXyz(10, 20, 30);
    const [layer] = asset.header.layers;
    const [{ numbers }] = asset.primitives;
    const same = rotateLighting(rotateLighting(lighting, there), transpose(there));
    expect(largestDifference(relight(layer, numbers[0], same), relight(layer, numbers[0], lighting))).toBeLessThan(1e-6);
});
