import { readFileSync } from 'node:fs';

import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';
import { beforeAll, describe, expect, it } from 'vitest';

import type { MeshoptDecoder as Decoder } from '../src/asset/gltf_document.js';
import { isGlossy } from '../src/asset/layer.js';
import { readAsset } from '../src/asset/read_asset.js';
import { OpenPrtError } from '../src/error.js';
import { receiveLight, relight } from '../src/relight/relight.js';
import { type Lighting, darkness } from '../src/sh/lighting.js';
import { type Damage, damagedBytes } from './support/damage.js';

// Sums over some hundred numbers of magnitude 1, which the library adds in floats.
const kRounding = 1e-4;

function lightOf(bandCount: number): Lighting {
    const light = darkness(bandCount);
    return { bandCount, coefficients: light.coefficients.map((_, k) => ((k % 3) + 1) / (Math.floor(k / 3) + 1)) };
}

/** As the library sums them; null where the bytes are refused. */
function numbersOf(bytes: Uint8Array): number[] | null {
    try {
        const { header, primitives } = readAsset(bytes, { meshoptDecoder: MeshoptDecoder as unknown as Decoder });
        return header.layers.map((layer, l) => {
            let [sum, k] = [0, 0];
            for (const { numbers } of primitives)
                for (const number of (isGlossy(layer.transport) ? receiveLight : relight)(layer, numbers[l], lightOf(header.bandCount)))
                    sum += number * Math.cos(k++);
            return sum;
        });
    } catch (error) {
        if (!(error instanceof OpenPrtError)) throw error;
        return null;
    }
}

function isSame(a: number[] | null, b: number[] | null): boolean {
    if (!a || !b) return a === b;
    return a.length === b.length && a.every((number, i) => Math.abs(number - b[i]) <= kRounding * Math.max(1, Math.abs(b[i])));
}

const path = process.env.PRT_DAMAGED_ASSETS;

describe.skipIf(!path)('thousands of damaged files', () => {
    beforeAll(() => MeshoptDecoder.ready as Promise<void>);

    it('are refused where the library refuses them, and else have the same numbers', () => {
        const damages: Damage[] = JSON.parse(readFileSync(path!, 'utf8'));
        const refusedCount = damages.filter(({ numbers }) => !numbers).length;
        expect(refusedCount).toBeGreaterThan(4000);
        expect(damages.length - refusedCount).toBeGreaterThan(1000);
        const others = damages.flatMap((damage) => {
            const numbers = numbersOf(damagedBytes(damage));
            return isSame(numbers, damage.numbers) ? [] : [{ ...damage, here: numbers }];
        });
        expect(others.map((other) => JSON.stringify(other))).toEqual([]);
    });
});
