import { readFileSync } from 'node:fs';

import type { Encoding } from '../../src/asset/layer.js';

/** Assets that every version of the library reads; what they hold is a formula (tests/asset/golden_asset_test.cpp). */
export function goldenBytes(version: string, encoding: Encoding): Uint8Array {
    return new Uint8Array(readFileSync(new URL(`../../../../tests/asset/golden/${version}-${encoding}.prt.glb`, import.meta.url)));
}

export const kEncodings: Encoding[] = ['float32', 'unorm16', 'unorm8'];
export const kVersions = ['1.0', '1.1', '1.2'];
export const kGoldenVertexCount = 13;

function storedNumber(vertex: number, column: number): number {
    return (17 * vertex + 5 * column) % 251;
}

function storedCoefficient(encoding: Encoding, row: number, column: number): number {
    if (encoding === 'float32') return storedNumber(row, column) / 1024;
    return -0.25 + ((0.5 + column / 64) * storedNumber(row, column)) / (encoding === 'unorm16' ? 65535 : 255);
}

/** Coefficient `column` of a vertex, without clusters and with the three clusters of the golden assets. */
export function goldenCoefficient(encoding: Encoding, hasClusters: boolean, vertex: number, column: number): number {
    if (!hasClusters) return storedCoefficient(encoding, vertex, column);
    const cluster = vertex % 3;
    const firstRow = [0, 3, 4][cluster];
    let sum = storedCoefficient(encoding, firstRow, column);
    for (let p = 1; p <= [2, 0, 1][cluster]; ++p)
        sum += (storedNumber(vertex, p) / (encoding === 'float32' ? 256 : 255)) * storedCoefficient(encoding, firstRow + p, column);
    return sum;
}
