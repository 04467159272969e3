import { readFileSync } from 'node:fs';

import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';
import { beforeAll, describe, expect, it } from 'vitest';

import { checksumOf } from '../src/asset/crc32.js';
import type { MeshoptDecoder as Decoder } from '../src/asset/gltf_document.js';
import { readAsset } from '../src/asset/read_asset.js';
import { coefficientsOf } from '../src/relight/coefficients.js';
import { headerOf, joinGlb, openGlb } from './support/glb_file.js';

// A bumpy grid of 121 vertices, that `prt compress --method u8` wrote without and with --meshopt.
const [plainBytes, bytes] = ['plain', 'meshopt'].map((name) => new Uint8Array(readFileSync(new URL(`assets/${name}.prt.glb`, import.meta.url))));
const options = { meshoptDecoder: MeshoptDecoder as unknown as Decoder };

/** Coefficients of all vertices as texts in order of the alphabet: encoding vertices for meshopt changes their order. */
function rowsOf(asset: ReturnType<typeof readAsset>, l: number): string[] {
    const layer = asset.header.layers[l];
    return asset.primitives
        .flatMap(({ numbers, vertexCount }) => {
            const values = coefficientsOf(layer, numbers[l]);
            return Array.from({ length: vertexCount }, (_, vertex) => values.slice(vertex * layer.coefficientCount, (vertex + 1) * layer.coefficientCount).join());
        })
        .sort();
}

describe('an asset encoded by EXT_meshopt_compression', () => {
    beforeAll(() => MeshoptDecoder.ready as Promise<void>);

    it('holds what it held', () => {
        const [encoded, plain] = [readAsset(bytes, options), readAsset(plainBytes)];
        expect(rowsOf(encoded, 0).length).toBe(121);
        expect(rowsOf(encoded, 0)).toEqual(rowsOf(plain, 0));
    });

    it('is refused without a decoder, in a sentence', () => expect(() => readAsset(bytes)).toThrow('no decoder of it was given'));

    it.each([
        ['promises more than its bytes can hold', (extension: any, view: any, json: any) => {
            json.buffers[1].byteLength = 1e12;
            view.byteLength = 256 * (extension.count = 1e9);
            extension.byteStride = 256;
        }],
        ['does not fit the length', (extension: any) => ++extension.count],
        ['is not aligned', (_: any, view: any) => ++view.byteOffset],
        ['ends behind its buffer', (extension: any) => (extension.byteLength = 1e9)],
    ])('that %s is refused', (complaint, change) => {
        const file = openGlb(bytes);
        const view = file.json.bufferViews.find((candidate: any) => candidate.extensions);
        change(view.extensions.EXT_meshopt_compression, view, file.json);
        expect(() => readAsset(joinGlb(file), options)).toThrow(complaint);
    });

    it.each([false, true])('whose bytes are damaged is refused, with checksums of views that fit: %s', (isForged) => {
        const file = openGlb(bytes);
        const index = file.json.bufferViews.findIndex((candidate: any) => candidate.extensions);
        const { byteOffset = 0, byteLength } = file.json.bufferViews[index].extensions.EXT_meshopt_compression;
        const stored = file.binary.subarray(byteOffset, byteOffset + byteLength).fill(0xff);
        if (isForged) headerOf(file).checksums[index] = checksumOf(stored);
        expect(() => readAsset(joinGlb(file), options)).toThrow(isForged ? 'cannot be decoded' : `buffer view ${index} is damaged`);
    });
});
