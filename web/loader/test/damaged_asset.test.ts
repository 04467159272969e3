import { isDeepStrictEqual } from 'node:util';

import { describe, expect, it } from 'vitest';

import { type Asset, readAsset } from '../src/asset/read_asset.js';
import { OpenPrtError } from '../src/error.js';
import {
    type GlbFile, accessorBytes, boundOf, clustersOf, headerOf, joinGlb, layerOf, openGlb, primitiveOf, repairChecksums,
} from './support/glb_file.js';
import { goldenBytes, kEncodings } from './support/golden.js';

/** What the bytes hold, or why they are refused. */
function readOrRefuse(bytes: Uint8Array): Asset | OpenPrtError {
    try {
        return readAsset(bytes);
    } catch (error) {
        if (!(error instanceof OpenPrtError)) throw error;
        return error;
    }
}

function refusalOf(bytes: Uint8Array): OpenPrtError | undefined {
    const result = readOrRefuse(bytes);
    return result instanceof OpenPrtError ? result : undefined;
}

function binaryChunkOf(bytes: Uint8Array): number {
    return 20 + new DataView(bytes.buffer).getUint32(12, true);
}

describe.each(kEncodings)('of the asset with all forms in %s', (encoding) => {
    const bytes = goldenBytes('1.2', encoding);

    it('every prefix is refused', () => {
        for (let size = 0; size < bytes.length; ++size) if (!refusalOf(bytes.slice(0, size))) throw new Error(`${size} bytes are read`);
    });

    it('every flipped bit of the binary chunk is refused', () => {
        const changed = bytes.slice();
        for (let i = binaryChunkOf(bytes); i < bytes.length; ++i) {
            changed[i] ^= 1 << i % 8;
            if (!refusalOf(changed)) throw new Error(`byte ${i} may change`);
            changed[i] ^= 1 << i % 8;
        }
        expect(refusalOf(changed)).toBeUndefined();
    });

    it('a flipped bit of the JSON is refused, or leaves the numbers as they were', () => {
        const changed = bytes.slice();
        const original = readAsset(bytes);
        let refusalCount = 0;
        for (let i = 0; i < binaryChunkOf(bytes); i += 3) {
            changed[i] ^= 1 << i % 7;
            const result = readOrRefuse(changed);
            if (result instanceof OpenPrtError) ++refusalCount;
            else if (!isDeepStrictEqual([result.header.layers, result.primitives], [original.header.layers, original.primitives]))
                throw new Error(`byte ${i} changes the numbers`);
            changed[i] ^= 1 << i % 7;
        }
        expect(refusalCount).toBeGreaterThan(binaryChunkOf(bytes) / 6);
    });
});

type Mutant = [name: string, change: (file: GlbFile) => void, complaint: string];

/** Checksums are made to fit again: what is refused makes no sense of itself. */
function itRefuses(bytes: Uint8Array, mutants: Mutant[]): void {
    it.each(mutants)('%s', (_, change, complaint) => {
        const file = openGlb(bytes);
        change(file);
        repairChecksums(file);
        expect(refusalOf(joinGlb(file))?.message).toContain(complaint);
    });
}

const withHeader = (key: string, value: unknown, complaint: string): Mutant => [
    `${key} ${JSON.stringify(value)}`, (file) => void (headerOf(file)[key] = value), complaint,
];
const withLayer = (index: number, key: string, value: unknown, complaint: string): Mutant => [
    `${key} ${JSON.stringify(value)} of layer ${index}`, (file) => void (layerOf(file, index)[key] = value), complaint,
];

describe('headers that make no sense', () =>
    itRefuses(goldenBytes('1.2', 'unorm8'), [
        ...[0, 11, 4294967298, -2, 2.5, '2'].map((bands) => withHeader('bands', bands, 'bands')),
        withHeader('bands', 3, 'numbers'),
        withHeader('convention', 'rh', '"rh"'),
        withHeader('quantity', 'glossy', '"glossy"'),
        withHeader('provenance', undefined, 'provenance'),
        ['seed of 65 bits', (f) => void (headerOf(f).provenance.seed = '18446744073709551616'), 'seed'],
        ['seed as a number', (f) => void (headerOf(f).provenance.seed = 1), 'seed'],
        ['too many samples', (f) => void (headerOf(f).provenance.sampleCount = 2 ** 31), 'sampleCount'],
        withHeader('layers', [], 'layer'),
        withHeader('layers', 5, 'array'),
        withHeader('version', undefined, 'version'),
        withHeader('vertices', 9, '13 vertices'),
        ['a mesh less', (f) => void delete f.json.nodes.find((node: any) => node.mesh === 1).mesh, '9 vertices'],
        ['a checksum less', (f) => void headerOf(f).checksums.pop(), 'checksums'],
        ['a view more', (f) => void f.json.bufferViews.push(f.json.bufferViews[0]), 'checksums'],
    ]));

describe('layers that make no sense', () =>
    itRefuses(goldenBytes('1.2', 'unorm8'), [
        withLayer(0, 'transport', 'interreflected', 'different'),
        withLayer(0, 'transport', 'subsurface', 'transport'),
        withLayer(0, 'encoding', 'unorm4', 'encoding'),
        withLayer(0, 'encoding', 'unorm16', 'form'),
        withLayer(0, 'channels', 2, '1 or 3'),
        withLayer(0, 'channels', 0, '1 or 3'),
        withLayer(0, 'channels', 3, 'numbers'),
        withLayer(0, 'scale', [0.1, 0.1, 0.1], 'scale'),
        withLayer(0, 'scale', [0.1, -0.1, 0.1, 0.1], 'negative'),
        withLayer(0, 'scale', [0.1, 1e30, 0.1, 0.1], '100'),
        withLayer(0, 'bias', [0.1, 0.1, -101, 0.1], '100'),
        withLayer(0, 'bias', [null, 0.1, 0.1, 0.1], 'bias'),
        withLayer(0, 'attributes', { first: 0, count: 0 }, 'count'),
        withLayer(1, 'attributes', { first: 0, count: 1 }, 'one after the other'),
        withLayer(3, 'attributes', { first: 99, count: 1 }, '_PRT_99'),
        withLayer(0, 'attributes', { first: 9007199254740991, count: 1 }, 'one after the other'),
        ...[0, 10, 2.5, undefined].map((bands) => withLayer(2, 'incidentBands', bands, 'incidentBands')),
        withLayer(2, 'incidentBands', 2, 'numbers'),
        ...[0, -0.01, 101, '0.01', null].map((error) => withLayer(0, 'largestError', error, 'largestError')),
    ]));

const withClusters = (key: string, value: unknown, complaint: string): Mutant => [
    `${key} ${JSON.stringify(value)?.slice(0, 40)}`, (file) => void (clustersOf(file)[key] = value), complaint,
];

describe('clusters that make no sense', () => {
    itRefuses(goldenBytes('1.1', 'unorm8'), [
        ['that are not there', (file) => void delete layerOf(file, 1).clusters, 'clusters'],
        ...['weights', 'components', 'encoding', 'scale', 'bias', 'accessor'].map((key) => withClusters(key, undefined, `lacks "${key}"`)),
        withClusters('components', [], '1 to 256 clusters'),
        withClusters('components', Array(257).fill(0), '1 to 256 clusters'),
        withClusters('components', [2, 1], 'number of elements'),
        withClusters('components', [2, 0, 1, 0], 'number of elements'),
        withClusters('components', [0, 2, 1], 'component'),
        withClusters('components', [2, 0, 4], 'attributes'),
        ...[256, 4000000000, -1, 0.5].map((count) => withClusters('components', [2, 0, count], 'whole number')),
        withClusters('components', '203', 'array'),
        withClusters('encoding', 'unorm16', 'form'),
        withClusters('encoding', 'unorm4', 'encoding'),
        withClusters('weights', 'unorm16', 'form'),
        withClusters('weights', 'clusters', 'weights'),
        withClusters('scale', Array(12).fill(-0.1), 'negative'),
        withClusters('bias', Array(11).fill(0.1), 'bias'),
        withClusters('accessor', 99, 'accessor 99'),
        withClusters('accessor', 9007199254740991, 'accessor'),
        withClusters('accessor', 3, 'form'),
    ]);

    const withFloat = (name: string, value: number, column: number, complaint: string): Mutant => [
        name,
        (file) => {
            const { _PRT_1: attribute } = primitiveOf(file, 0).attributes; // vertex 0 is in cluster 0, vertex 1 in cluster 1
            const bytes = accessorBytes(file, attribute);
            new DataView(bytes.buffer, bytes.byteOffset).setFloat32(4 * column, value, true);
        },
        complaint,
    ];
    itRefuses(goldenBytes('1.1', 'float32'), [
        ...[3, 0.5, -1].map((cluster) => withFloat(`cluster ${cluster}`, cluster, 0, 'a cluster that is not there')),
        ...[NaN, Infinity, 1e30].map((cluster) => withFloat(`cluster ${cluster}`, cluster, 0, 'not finite')),
        withFloat('a weight above 1', 1.0001, 1, 'beyond 0 and 1'),
        withFloat('a negative weight', -0.0001, 2, 'beyond 0 and 1'),
        withFloat('a weight too many', 0.5, 5, 'a component that its cluster does not have'),
        withFloat('padding', 0.5, 3, 'beyond the last'),
        [
            'vectors that are no transfer',
            (file) => {
                const bytes = accessorBytes(file, clustersOf(file).accessor);
                new DataView(bytes.buffer, bytes.byteOffset).setFloat32(20, 100.5, true);
            },
            '100',
        ],
    ]);
});

describe('meshes that do not fit', () =>
    itRefuses(goldenBytes('1.2', 'unorm8'), [
        ['an attribute missing', (f) => void delete primitiveOf(f, 1).attributes._PRT_3, '_PRT_3'],
        ['an attribute that is not bound', (f) => void delete boundOf(f, 1)._PRT_3, '_PRT_3'],
        ['a primitive without the object', (f) => void (primitiveOf(f, 0).extensions = {}), 'no radiance transfer'],
        ['a vertex less', (f) => void --f.json.accessors[primitiveOf(f, 0).attributes._PRT_0].count, 'number'],
        ['not normalised', (f) => void delete f.json.accessors[primitiveOf(f, 0).attributes._PRT_0].normalized, 'form'],
        ['moved', (f) => void (f.json.nodes[1].translation = [0, 0.5, 0]), 'moved'],
        ['two corners', (f) => void (f.json.accessors[primitiveOf(f, 0).indices].count = 2), 'no triangle'],
        ['no triangles', (f) => void (primitiveOf(f, 0).mode = 1), 'triangles'],
        ['a material that is not there', (f) => void (primitiveOf(f, 0).material = 5), 'no material'],
        ['a material of three numbers', (f) => void f.json.materials[0].pbrMetallicRoughness.baseColorFactor.pop(), 'four numbers'],
        ['a view that is not aligned', (f) => void (f.json.bufferViews[f.json.accessors[primitiveOf(f, 0).attributes.POSITION].bufferView].byteOffset = 5), 'aligned'],
        [
            'an index of a vertex that is not there',
            (f) => void accessorBytes(f, primitiveOf(f, 0).indices).fill(255),
            'a vertex that is not there',
        ],
        ['absurdly many', (f) => void (f.json.accessors[primitiveOf(f, 0).attributes.POSITION].count = 2 ** 50), 'vertices'],
        ['a buffer view behind the end', (f) => void (f.json.bufferViews[0].byteLength = 2 ** 50), 'ends behind'],
        ['a requirement', (f) => void (f.json.extensionsRequired = ['ACME_other_vertices']), 'ACME_other_vertices'],
        [
            'placed twice',
            (f) => {
                f.json.nodes.push({ ...f.json.nodes[0] });
                f.json.scenes[0].nodes.push(f.json.nodes.length - 1);
            },
            'twice',
        ],
        [
            'a node that is its own parent',
            (f) => {
                f.json.nodes[0].children = [0];
            },
            'parent',
        ],
    ]));

describe('small files that ask for much work', () => {
    itRefuses(goldenBytes('1.2', 'float32'), [
        [
            'attributes that are all the same bytes',
            (f) => {
                const { accessors, bufferViews, meshes } = f.json;
                for (const { primitives } of meshes)
                    for (const { attributes } of primitives)
                        for (const name of Object.keys(attributes).filter((key) => /^_PRT_[1-9]/.test(key))) {
                            bufferViews[accessors[attributes[name]].bufferView].byteLength = 4;
                            attributes[name] = attributes._PRT_0;
                        }
            },
            'fewer bytes',
        ],
        [
            'buffer views that are all the same bytes',
            (f) => {
                for (let i = 0; i < 100; ++i) f.json.bufferViews.push({ buffer: 0, byteLength: f.binary.length });
                headerOf(f).checksums.push(...Array(100).fill(''));
            },
            'over and over',
        ],
    ]);
});
