import { readFileSync } from 'node:fs';

import { type Lighting, parseLighting } from '../../src/sh/lighting.js';

/** What the library computes (tests/web/write_web_vectors.cpp): as it did once, or as PRT_VECTORS says that it does now. */
export const vectors: Record<string, object[]> = JSON.parse(readFileSync(process.env.PRT_VECTORS ?? new URL('../vectors.json', import.meta.url), 'utf8'));

export const lightOf = (json: unknown): Lighting => parseLighting(json);

/** The largest difference of two lists, which must be of one length. */
export function largestDifference(a: ArrayLike<number>, b: ArrayLike<number>): number {
    if (a.length !== b.length || a.length === 0) throw new Error(`${a.length} numbers and ${b.length}`);
    let largest = 0;
    for (let i = 0; i < a.length; ++i) {
        const difference = Math.abs(a[i] - b[i]);
        if (!(difference <= largest)) largest = difference;
    }
    return largest;
}

/** The same of lights. */
export function lightDifference(a: Lighting, b: Lighting): number {
    return largestDifference(a.coefficients, b.coefficients);
}
