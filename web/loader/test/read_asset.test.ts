import { describe, expect, it } from 'vitest';

import { checksumOf } from '../src/asset/crc32.js';
import { kTransports } from '../src/asset/layer.js';
import { readAsset } from '../src/asset/read_asset.js';
import { OpenPrtError } from '../src/error.js';
import { coefficientsOf } from '../src/relight/coefficients.js';
import { type GlbFile, boundOf, headerOf, joinGlb, layerOf, openGlb, primitiveOf, repairChecksums } from './support/glb_file.js';
import { goldenBytes, goldenCoefficient, kEncodings, kGoldenVertexCount, kVersions } from './support/golden.js';

// Coefficients are floats of magnitude 1.
const kRounding = 3e-7;

const versionsAndEncodings = kVersions.flatMap((version) => kEncodings.map((encoding) => ({ version, encoding })));

describe('the assets that are read for ever', () => {
    it.each(versionsAndEncodings)('$version $encoding holds what was written', ({ version, encoding }) => {
        const asset = readAsset(goldenBytes(version, encoding));
        const { header, primitives } = asset;
        expect(header.bandCount).toBe(2);
        expect(header.vertexCount).toBe(kGoldenVertexCount);
        expect(header.provenance.seed).toBe(18446744073709551615n);
        expect(header.layers.map((layer) => layer.transport)).toEqual(
            version === '1.2' ? kTransports.slice(1) : ['shadowed', 'interreflected'],
        );
        expect(header.layers.map((layer) => layer.incidentBandCount)).toEqual(version === '1.2' ? [0, 0, 3, 2] : [0, 0]);
        let checkCount = 0;
        header.layers.forEach((layer, l) => {
            expect(layer.clusters !== undefined).toBe(version !== '1.0' && l % 2 === 1);
            let firstVertex = 0;
            for (const primitive of primitives) {
                const values = coefficientsOf(layer, primitive.numbers[l]);
                expect(values.length).toBe(primitive.vertexCount * layer.coefficientCount);
                values.forEach((value, i) => {
                    const vertex = firstVertex + Math.floor(i / layer.coefficientCount);
                    const expected = goldenCoefficient(encoding, layer.clusters !== undefined, vertex, i % layer.coefficientCount);
                    expect(Math.abs(value - expected)).toBeLessThan(kRounding);
                    ++checkCount;
                });
                firstVertex += primitive.vertexCount;
            }
        });
        expect(checkCount).toBe(kGoldenVertexCount * (version === '1.2' ? 4 + 12 + 36 + 48 : 4 + 12));
    });
});

describe('checksums', () => {
    it('are the CRC-32 of ISO 3309', () => {
        expect(checksumOf(new TextEncoder().encode('123456789'))).toBe('cbf43926');
        expect(checksumOf(new Uint8Array(0))).toBe('00000000');
    });
});

function refusalOf(file: GlbFile): OpenPrtError {
    try {
        readAsset(joinGlb(file));
    } catch (error) {
        expect(error).toBeInstanceOf(OpenPrtError);
        return error as OpenPrtError;
    }
    throw new Error('the file was read');
}

describe('versions', () => {
    it('of another major number are refused in a sentence that names both', () => {
        const file = openGlb(goldenBytes('1.2', 'unorm8'));
        headerOf(file).version = '2.3';
        expect(refusalOf(file).code).toBe('unsupported');
        expect(refusalOf(file).message).toMatch(/2\.3.*1\.2/);
    });

    it.each(['', '1', '1.', '.0', '1.0.0', '1.x', 'v1.0', '-1.0', '1.-1', ' 1.0', '1.99999999999'])('"%s" is none', (version) => {
        const file = openGlb(goldenBytes('1.2', 'unorm8'));
        headerOf(file).version = version;
        expect(refusalOf(file).code).toBe('malformed');
    });

    it('with a newer minor number are read, and what they add is passed over', () => {
        const file = openGlb(goldenBytes('1.1', 'unorm8'));
        const header = headerOf(file);
        header.version = '1.7';
        header.novelty = [1, 2, 3];
        header.layers[0].novelty = true;
        const unknown = { ...header.layers[1], transport: 'subsurface' };
        header.layers.push(unknown, { ...header.layers[1], clusters: { ...header.layers[1].clusters, weights: 'unorm4' } });
        repairChecksums(file);
        expect(readAsset(joinGlb(file)).header.layers.length).toBe(2);
        header.layers = [unknown];
        expect(refusalOf(file).message).toContain('no layer');
    });

    it('older than what they hold are refused', () => {
        const file = openGlb(goldenBytes('1.1', 'unorm8'));
        headerOf(file).version = '1.0';
        expect(refusalOf(file).message).toContain('1.0');
        const matrices = openGlb(goldenBytes('1.2', 'unorm8'));
        headerOf(matrices).version = '1.1';
        expect(refusalOf(matrices).message).toContain('1.1');
    });

    it('have nothing to do with a plain glTF, which is told from a damaged asset', () => {
        const file = openGlb(goldenBytes('1.2', 'unorm8'));
        delete file.json.extensions;
        expect(refusalOf(file).code).toBe('unsupported');
    });
});

describe('the glTF around it', () => {
    it('may replace elements sparsely, and name no scene', () => {
        const bytes = goldenBytes('1.2', 'float32');
        const original = readAsset(bytes);
        const file = openGlb(bytes);
        delete file.json.scene;
        const attribute = file.json.accessors[primitiveOf(file, 0).attributes._PRT_0];
        const view = file.json.bufferViews[attribute.bufferView];
        // Elements 2 and 3 of the view's bytes move behind, and others take their place.
        const moved = file.binary.slice(view.byteOffset + 32, view.byteOffset + 64);
        const end = file.binary.length;
        const binary = new Uint8Array(end + 36);
        binary.set(file.binary);
        binary.set([2, 3], end);
        binary.set(moved, end + 4);
        file.binary = binary;
        file.binary.fill(7, view.byteOffset + 32, view.byteOffset + 64);
        file.json.buffers[0].byteLength = binary.length;
        file.json.bufferViews.push({ buffer: 0, byteOffset: end, byteLength: 36 });
        const bufferView = file.json.bufferViews.length - 1;
        attribute.sparse = { count: 2, indices: { bufferView, componentType: 5121 }, values: { bufferView, byteOffset: 4 } };
        const checksums = { ...boundOf(file, 0) };
        headerOf(file).checksums.push('');
        repairChecksums(file);
        Object.assign(boundOf(file, 0), checksums);
        expect(readAsset(joinGlb(file)).primitives).toEqual(original.primitives);
        file.binary.set([3, 2], end);
        repairChecksums(file);
        Object.assign(boundOf(file, 0), checksums);
        expect(refusalOf(file).message).toContain('ascend');
    });

    it('may be interleaved', () => {
        const bytes = goldenBytes('1.2', 'unorm8');
        const original = readAsset(bytes);
        const file = openGlb(bytes);
        const attribute = file.json.accessors[primitiveOf(file, 0).attributes._PRT_0];
        const { byteOffset } = file.json.bufferViews[attribute.bufferView];
        const begin = file.binary.length;
        const binary = new Uint8Array(begin + 12 * attribute.count);
        binary.set(file.binary);
        for (let i = 0; i < attribute.count; ++i) binary.set(file.binary.subarray(byteOffset + 4 * i, byteOffset + 4 * i + 4), begin + 12 * i + 8);
        file.binary = binary;
        file.json.buffers[0].byteLength = binary.length;
        attribute.bufferView = file.json.bufferViews.push({ buffer: 0, byteOffset: begin, byteLength: 12 * attribute.count, byteStride: 12 }) - 1;
        attribute.byteOffset = 8;
        headerOf(file).checksums.push('');
        const checksums = { ...boundOf(file, 0) };
        repairChecksums(file);
        Object.assign(boundOf(file, 0), checksums);
        expect(readAsset(joinGlb(file)).primitives).toEqual(original.primitives);
    });
});

describe('the examples of docs/format.md', () => {
    it('have the checksums that the page says', () => {
        const file = openGlb(goldenBytes('1.0', 'unorm16'));
        headerOf(file).layers.pop();
        Object.assign(layerOf(file, 0), { scale: [0.25, 0.5, 0.5, 0.5], bias: [0.0, -0.25, -0.25, -0.25], checksum: '1e97d30d' });
        expect(readAsset(joinGlb(file)).header.layers.length).toBe(1);
    });

    it('have clusters whose vectors and sums are those of the page', () => {
        const file = openGlb(goldenBytes('1.1', 'unorm8'));
        const header = headerOf(file);
        header.layers = [
            {
                transport: 'shadowed', channels: 1, encoding: 'clusters', attributes: { first: 0, count: 1 },
                clusters: {
                    weights: 'unorm8', components: [2, 0], encoding: 'unorm8',
                    scale: [0.25, 0.5, 0.5, 0.5], bias: [0.0, -0.25, -0.25, -0.25],
                    accessor: 0, checksum: '8b2875b3',
                },
                checksum: '717296f4',
            },
        ];
        const vectors = file.json.accessors[0];
        vectors.count = 16;
        const begin = file.json.bufferViews[vectors.bufferView].byteOffset ?? 0;
        file.binary.set([100, 128, 200, 128, 51, 0, 102, 255, 255, 204, 0, 51, 153, 255, 128, 128], begin);
        for (const mesh of [0, 1]) {
            const attribute = file.json.accessors[file.json.meshes[mesh].primitives[0].attributes._PRT_0];
            const at = file.json.bufferViews[attribute.bufferView].byteOffset;
            for (let vertex = 0; vertex < attribute.count; ++vertex)
                file.binary.set(vertex % 2 ? [1, 0, 0, 0] : [0, 255, 51, 0], at + 4 * vertex);
        }
        repairChecksums(file);
        expect(layerOf(file, 0).checksum).toBe('717296f4');
        const asset = readAsset(joinGlb(file));
        const values = coefficientsOf(asset.header.layers[0], asset.primitives[0].numbers[0]);
        [0.198039216, -0.219019608, 0.042156863, 0.220980392, 0.15, 0.25, 0.000980392, 0.000980392].forEach((value, i) =>
            expect(Math.abs(values[i] - value)).toBeLessThan(kRounding),
        );
    });
});
