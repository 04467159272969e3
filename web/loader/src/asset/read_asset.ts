import { OpenPrtError } from '../error.js';
import { checksumOf } from './crc32.js';
import { splitGlb } from './glb.js';
import { type AccessorForm, GltfDocument, type MeshoptDecoder } from './gltf_document.js';
import { type Header, kExtension, kMaxCoefficient, parseHeader } from './header.js';
import { JsonCursor } from './json_cursor.js';
import { type Encoding, type Layer, type StoredArray, arrayOver, bytesPerNumber, largestStored } from './layer.js';
import { checkMaterials } from './materials.js';
import { type ShownPrimitive, listShownPrimitives } from './shown_primitives.js';

/** What is stored of the vertices of one primitive. */
export interface AssetPrimitive {
    /** Index of its mesh in the glTF, and its own in the mesh. */
    mesh: number;
    primitive: number;
    vertexCount: number;
    /** One a layer: 4 · attributeCount numbers a vertex, those after the first N zero. */
    numbers: StoredArray[];
    /** Unit normals of the bake, three numbers a vertex. */
    normals: Float32Array;
}

/** Radiance transfer, read and checked; read-only. */
export interface Asset {
    header: Header;
    primitives: AssetPrimitive[];
}

/** A layer of the kind, or undefined. */
export function findLayer(asset: Asset, transport: string): Layer | undefined {
    return asset.header.layers.find((layer) => layer.transport === transport);
}

/** Whether a glTF has the root's object of the extension; others are plain scenes. */
export function isAsset(json: unknown): boolean {
    return new JsonCursor(json, 'glTF').find('extensions')?.find(kExtension) !== undefined;
}

export interface ReadOptions {
    /** Of EXT_meshopt_compression; must be ready. */
    meshoptDecoder?: MeshoptDecoder;
}

/** Reads an asset, NAME.prt.glb, and checks all that docs/format.md lets a reader check. */
export function readAsset(file: Uint8Array, options: ReadOptions = {}): Asset {
    const { json, binary } = splitGlb(file);
    checkBinaryChunk(json, binary);
    return readAssetParts(json, [binary], options);
}

/** The same of a glTF that is taken apart. @param buffers  the bytes of its buffers, of empty ones undefined */
export function readAssetParts(json: unknown, buffers: readonly (Uint8Array | undefined)[], options: ReadOptions = {}): Asset {
    if (!isAsset(json))
        throw new OpenPrtError('unsupported', `the file has no radiance transfer (${kExtension}): bake it first, with prt bake`);
    const document = new GltfDocument(json, buffers, options.meshoptDecoder);
    const header = parseHeader(document.root.at('extensions').at(kExtension));
    checkViews(document, header);
    header.layers.forEach((layer, i) => readVectors(document, layer, `layer ${i}`));

    checkMaterials(document);
    const shown = listShownPrimitives(document);
    const counts = shown.map(({ object }) => document.countOf(attributeOf(object, 'POSITION')));
    const vertexCount = counts.reduce((sum, count) => sum + count, 0);
    if (vertexCount !== header.vertexCount)
        throw new OpenPrtError('malformed', `the scene has ${vertexCount} vertices, and transfer is for ${header.vertexCount}`);
    const bytesPerVertex = header.layers.reduce((sum, layer) => sum + 4 * layer.attributeCount * bytesPerNumber(layer.storage.encoding), 0);
    if (vertexCount * bytesPerVertex > document.viewBytes())
        throw new OpenPrtError('malformed', `the file has fewer bytes than the ${bytesPerVertex} that its layers need for each vertex`);
    return { header, primitives: shown.map((primitive, i) => readPrimitive(document, header, primitive, counts[i])) };
}

/** A binary chunk is its buffer and at most three bytes more. */
function checkBinaryChunk(json: unknown, binary: Uint8Array): void {
    const [buffer] = new JsonCursor(json, 'glTF').find('buffers')?.elements() ?? [];
    const size = buffer && !buffer.find('uri') ? buffer.at('byteLength').toCount() : 0;
    const padding = binary.length - size;
    if (padding < 0 || padding > 3 || binary.subarray(size).some((byte) => byte !== 0))
        throw new OpenPrtError('malformed', `the binary chunk has ${binary.length} bytes, and its buffer ${size}`);
}

function checkViews(document: GltfDocument, { checksums }: Header): void {
    const views = document.storedViews();
    if (views.length !== checksums.length)
        throw new OpenPrtError('malformed', `the file has ${views.length} buffer views and ${checksums.length} checksums of them`);
    views.forEach((bytes, i) => {
        if (checksumOf(bytes) !== checksums[i])
            throw new OpenPrtError('malformed', `buffer view ${i} is damaged: its checksum differs`);
    });
}

function formOf(encoding: Encoding, type: string, count: number): AccessorForm {
    const componentType = encoding === 'float32' ? 5126 : encoding === 'unorm16' ? 5123 : 5121;
    return { type, componentType, normalized: encoding !== 'float32', count };
}

function readVectors(document: GltfDocument, layer: Layer, place: string): void {
    const { clusters } = layer;
    if (!clusters) return;
    const rowCount = clusters.componentCounts.reduce((sum, count) => sum + 1 + count, 0);
    const { encoding, scale, bias } = clusters.storage;
    const bytes = document.elementsOf(clusters.accessor, formOf(encoding, 'SCALAR', rowCount * layer.coefficientCount));
    if (checksumOf(bytes) !== clusters.checksum)
        throw new OpenPrtError('malformed', `the vectors of ${place} are damaged: their checksum differs`);
    const stored = arrayOver(encoding, bytes);
    requireBounded(stored, `the vectors of ${place}`);
    if (encoding === 'float32') {
        clusters.vectors = Float32Array.from(stored);
        return;
    }
    const largest = largestStored(encoding);
    clusters.vectors = new Float32Array(stored.length);
    for (let i = 0; i < stored.length; ++i) {
        const c = i % layer.coefficientCount;
        clusters.vectors[i] = bias[c] + (scale[c] * stored[i]) / largest;
    }
}

function requireBounded(numbers: StoredArray, place: string): void {
    if (numbers instanceof Float32Array && !numbers.every((number) => Math.abs(number) <= kMaxCoefficient))
        throw new OpenPrtError('malformed', `${place} have a number that is not finite or beyond ${kMaxCoefficient}`);
}

function attributeOf(primitive: JsonCursor, name: string): number {
    return primitive.at('attributes').at(name).toCount();
}

function readPrimitive(document: GltfDocument, header: Header, shown: ShownPrimitive, vertexCount: number): AssetPrimitive {
    const { object } = shown;
    const mine = object.find('extensions')?.find(kExtension) ?? object.reject('has no radiance transfer');
    const readBound = (name: string, form: AccessorForm): Uint8Array => {
        const bytes = document.elementsOf(attributeOf(object, name), form);
        const checksum = mine.at('checksums').at(name);
        if (checksum.toText() !== checksumOf(bytes)) checksum.reject(`differs: the data of ${name} are not those that were baked`);
        return bytes;
    };
    mine.at('checksums').keys().forEach((name) => mine.at('checksums').at(name).toText());
    for (const name of object.at('attributes').keys())
        if (document.countOf(attributeOf(object, name)) !== vertexCount)
            object.at('attributes').at(name).reject(`has another number of elements than ${vertexCount}`);
    checkTriangles(document, object, vertexCount);
    const floats = { type: 'VEC3', componentType: 5126, normalized: false, count: vertexCount };
    const positions = arrayOver('float32', readBound('POSITION', floats)) as Float32Array;
    const normals = arrayOver('float32', readBound('NORMAL', floats)) as Float32Array;
    if (!positions.every(Number.isFinite) || !normals.every(Number.isFinite)) object.reject('has a position or a normal that is not finite');

    const numbers = header.layers.map((layer) => {
        const form = formOf(layer.storage.encoding, 'VEC4', vertexCount);
        const merged = makeNumbers(layer, vertexCount);
        for (let a = 0; a < layer.attributeCount; ++a)
            merge(arrayOver(layer.storage.encoding, readBound(`_PRT_${layer.firstAttribute + a}`, form)), a, layer.attributeCount, merged);
        checkNumbers(layer, merged, `the ${layer.transport} coefficients of ${object.place}`);
        return merged;
    });
    return { mesh: shown.mesh, primitive: shown.primitive, vertexCount, numbers, normals };
}

function checkTriangles(document: GltfDocument, primitive: JsonCursor, vertexCount: number): void {
    if (![4, 5, 6].includes(primitive.find('mode')?.toCount() ?? 4)) primitive.reject('is not made of triangles');
    const reference = primitive.find('indices');
    if ((reference ? document.countOf(reference.toCount()) : vertexCount) < 3) primitive.reject('has no triangle');
    if (!reference) return;
    const form = document.formOf(reference.toCount());
    const isIndex = [5121, 5123, 5125].includes(form.componentType) && form.type === 'SCALAR' && !form.normalized;
    if (!isIndex) reference.reject('is an accessor that cannot hold indices');
    const bytes = document.elementsOf(reference.toCount(), form);
    const indices =
        form.componentType === 5125 ? new Uint32Array(bytes.slice().buffer) : arrayOver(form.componentType === 5123 ? 'unorm16' : 'unorm8', bytes);
    if (!indices.every((index: number) => index < vertexCount)) reference.reject('names a vertex that is not there');
}

function makeNumbers(layer: Layer, vertexCount: number): StoredArray {
    const length = vertexCount * 4 * layer.attributeCount;
    return arrayOver(layer.storage.encoding, new Uint8Array(length * bytesPerNumber(layer.storage.encoding)));
}

/** Puts an attribute's numbers beside those of the others. */
function merge(attribute: StoredArray, index: number, attributeCount: number, merged: StoredArray): void {
    for (let i = 0; i < attribute.length; i += 4) {
        const to = i * attributeCount + 4 * index;
        for (let k = 0; k < 4; ++k) merged[to + k] = attribute[i + k];
    }
}

/** Demands numbers that transfer can be: bounded, of clusters that are there, and zero behind the last. */
function checkNumbers(layer: Layer, numbers: StoredArray, place: string): void {
    const refuse = (what: string): never => {
        throw new OpenPrtError('malformed', `${place} have ${what}`);
    };
    requireBounded(numbers, place);
    const width = 4 * layer.attributeCount;
    for (let row = 0; row < numbers.length; row += width) {
        for (let c = layer.numberCount; c < width; ++c) if (numbers[row + c] !== 0) refuse('a number beyond the last');
        if (!layer.clusters) continue;
        const { componentCounts, componentCount } = layer.clusters;
        const cluster = numbers[row];
        if (!Number.isInteger(cluster) || cluster < 0 || cluster >= componentCounts.length) refuse('a cluster that is not there');
        for (let p = 1; p <= componentCount; ++p) {
            const weight = numbers[row + p];
            if (weight < 0 || weight > largestStored(layer.storage.encoding)) refuse('a weight beyond 0 and 1');
            if (p > componentCounts[cluster] && weight !== 0) refuse('a weight of a component that its cluster does not have');
        }
    }
}
