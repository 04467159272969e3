import { OpenPrtError } from '../error.js';
import { checksumOf } from './crc32.js';
import { JsonCursor } from './json_cursor.js';
import { type Clusters, type Encoding, type Layer, type Storage, type Transport, isGlossy, kTransports } from './layer.js';

export const kExtension = 'OPENPRT_radiance_transfer';
export const kVersionMajor = 1;
export const kVersionMinor = 2;
export const kMaxBandCount = 10;
/** No coefficient, scale or bias is larger. */
export const kMaxCoefficient = 100;

const kConvention = 'cs';
const kQuantity = 'outgoingRadianceOverAlbedo';
const kEncodings: readonly string[] = ['float32', 'unorm16', 'unorm8'];
const kMaxInt = 2147483647;

/** How an asset was made. */
export interface Provenance {
    generator: string;
    command: string;
    sampleCount: number;
    bounceCount: number;
    seed: bigint;
    isa: string;
}

/** What the root's object of the extension says. */
export interface Header {
    minorVersion: number;
    bandCount: number;
    vertexCount: number;
    provenance: Provenance;
    layers: Layer[];
    /** One for each buffer view. */
    checksums: string[];
}

/** Reads and checks the object of the root; vectors of clusters are still to be read. */
export function parseHeader(root: JsonCursor): Header {
    const minorVersion = parseVersion(root.at('version'));
    requireValue(root.at('convention'), kConvention);
    requireValue(root.at('quantity'), kQuantity);
    const bandCount = root.at('bands').toCount(1, kMaxBandCount);
    const vertexCount = root.at('vertices').toCount();
    const provenance = parseProvenance(root.at('provenance'));
    const layers: Layer[] = [];
    for (const object of root.at('layers').elements()) {
        const kind = parseKind(object, minorVersion);
        if (kind) layers.push(parseLayer(object, kind, bandCount));
    }
    checkOrder(root.at('layers'), layers);
    const checksums = root.at('checksums').elements().map((checksum) => checksum.toText());
    return { minorVersion, bandCount, vertexCount, provenance, layers, checksums };
}

function parseVersion(cursor: JsonCursor): number {
    const text = cursor.toText();
    const [, major, minor] = /^([0-9]+)\.([0-9]+)$/.exec(text) ?? cursor.reject('must be two numbers and a dot');
    if (Number(major) > kMaxInt || Number(minor) > kMaxInt) cursor.reject('is no version that can be');
    if (Number(major) !== kVersionMajor)
        throw new OpenPrtError(
            'unsupported',
            `the file has radiance transfer of version ${text}, and this reader knows version ${kVersionMajor}.${kVersionMinor}`,
        );
    return Number(minor);
}

function requireValue(cursor: JsonCursor, known: string): void {
    if (cursor.toText() !== known)
        throw new OpenPrtError('unsupported', `${cursor.place} is "${cursor.toText()}", and this reader knows "${known}"`);
}

function parseProvenance(object: JsonCursor): Provenance {
    const seed = object.at('seed');
    if (!/^[0-9]{1,20}$/.test(seed.toText()) || BigInt(seed.toText()) >= 1n << 64n)
        seed.reject('must be a whole number below 2^64, as text');
    return {
        generator: object.at('generator').toText(),
        command: object.at('command').toText(),
        sampleCount: object.at('sampleCount').toCount(0, kMaxInt),
        bounceCount: object.at('bounceCount').toCount(0, kMaxInt),
        seed: BigInt(seed.toText()),
        isa: object.at('isa').toText(),
    };
}

interface LayerKind {
    transport: Transport;
    encoding: Encoding;
    vectorsEncoding?: Encoding;
}

/** The transport and the encodings of a layer; nothing where a newer minor version names one that is not known here. */
function parseKind(object: JsonCursor, minorVersion: number): LayerKind | undefined {
    const reject = (member: JsonCursor): never => member.reject(`is none that a file of version 1.${minorVersion} can have`);
    const transport = object.at('transport');
    const encoding = object.at('encoding');
    const hasClusters = encoding.toText() === 'clusters';
    if (hasClusters && minorVersion < 1) reject(encoding);
    const weights = hasClusters ? object.at('clusters').at('weights') : encoding;
    const vectors = hasClusters ? object.at('clusters').at('encoding') : encoding;
    const unknown = !(kTransports as readonly string[]).includes(transport.toText())
        ? transport
        : [weights, vectors].find((member) => !kEncodings.includes(member.toText()));
    if (unknown && minorVersion > kVersionMinor) return undefined;
    if (unknown) unknown.reject(unknown === transport ? 'is no kind of transport' : 'is no encoding');
    const kind: LayerKind = { transport: transport.toText() as Transport, encoding: weights.toText() as Encoding };
    if (isGlossy(kind.transport) && minorVersion < 2) reject(transport);
    if (hasClusters) kind.vectorsEncoding = vectors.toText() as Encoding;
    return kind;
}

function parseLayer(object: JsonCursor, kind: LayerKind, bandCount: number): Layer {
    const channels = object.at('channels');
    if (channels.value !== 1 && channels.value !== 3) channels.reject('must be 1 or 3');
    const channelCount = channels.value as 1 | 3;
    const glossy = isGlossy(kind.transport);
    const incidentBandCount = glossy ? object.at('incidentBands').toCount(1, kMaxBandCount + 1 - bandCount) : 0;
    const coefficientCount = channelCount * bandCount ** 2 * (glossy ? incidentBandCount ** 2 : 1);

    const layer: Layer = {
        transport: kind.transport,
        channelCount,
        incidentBandCount,
        coefficientCount,
        numberCount: coefficientCount,
        firstAttribute: object.at('attributes').at('first').toCount(),
        attributeCount: object.at('attributes').at('count').toCount(),
        storage: { encoding: kind.encoding, scale: new Float32Array(0), bias: new Float32Array(0) },
        largestError: parseLargestError(object.find('largestError')),
    };
    if (kind.vectorsEncoding) {
        layer.clusters = parseClusters(object.at('clusters'), kind, coefficientCount);
        layer.numberCount = 1 + layer.clusters.componentCount;
    } else {
        layer.storage = parseStorage(object, kind.encoding, coefficientCount);
    }
    if (layer.attributeCount !== Math.ceil(layer.numberCount / 4))
        object.at('attributes').at('count').reject(`does not fit the ${layer.numberCount} numbers of a vertex`);
    if (object.at('checksum').toText() !== layerChecksum(layer, bandCount))
        object.reject('is damaged: its checksum differs');
    return layer;
}

function parseLargestError(member: JsonCursor | undefined): number {
    if (!member) return 0;
    const error = Math.fround(member.toNumber());
    if (!(error > 0 && error <= kMaxCoefficient)) member.reject(`must be above 0 and at most ${kMaxCoefficient}`);
    return error;
}

function parseStorage(object: JsonCursor, encoding: Encoding, count: number): Storage {
    if (encoding === 'float32') return { encoding, scale: new Float32Array(0), bias: new Float32Array(0) };
    const storage = { encoding, scale: parseFloats(object.at('scale'), count), bias: parseFloats(object.at('bias'), count) };
    if (storage.scale.some((scale) => scale < 0)) object.at('scale').reject('must not be negative');
    return storage;
}

function parseFloats(array: JsonCursor, count: number): Float32Array {
    const elements = array.elements();
    if (elements.length !== count) array.reject(`must have ${count} numbers, one for each coefficient`);
    return Float32Array.from(elements, (element) => {
        if (Math.abs(element.toNumber()) > kMaxCoefficient) element.reject(`must be at most ${kMaxCoefficient} in magnitude`);
        return element.toNumber();
    });
}

function parseClusters(object: JsonCursor, kind: LayerKind, coefficientCount: number): Clusters {
    const most = kind.encoding === 'unorm8' ? 256 : 65536;
    const components = object.at('components');
    const componentCounts = components.elements().map((count) => count.toCount(0, 255));
    if (componentCounts.length < 1 || componentCounts.length > most) components.reject(`must be of 1 to ${most} clusters`);
    const firstRows: number[] = [];
    let rowCount = 0;
    for (const count of componentCounts) {
        firstRows.push(rowCount);
        rowCount += 1 + count;
    }
    return {
        componentCounts,
        componentCount: componentCounts.reduce((largest, count) => Math.max(largest, count), 0),
        firstRows,
        storage: parseStorage(object, kind.vectorsEncoding!, coefficientCount),
        accessor: object.at('accessor').toCount(),
        checksum: object.at('checksum').toText(),
        vectors: new Float32Array(0),
    };
}

/** The CRC-32 of a text with all that the layer says, and of its ranges as little-endian floats. */
function layerChecksum(layer: Layer, bandCount: number): string {
    const { clusters } = layer;
    const words: (string | number)[] = [layer.transport, clusters ? 'clusters' : layer.storage.encoding, layer.channelCount];
    words.push(bandCount, layer.firstAttribute, layer.attributeCount);
    if (isGlossy(layer.transport)) words.push(layer.incidentBandCount);
    if (clusters)
        words.push(layer.storage.encoding, clusters.storage.encoding, clusters.checksum, clusters.componentCounts.join(' '));
    const text = new TextEncoder().encode(words.join(' '));
    const { scale, bias } = clusters ? clusters.storage : layer.storage;
    const floats = [...scale, ...bias];
    if (layer.largestError > 0) floats.push(layer.largestError);

    const bytes = new Uint8Array(text.length + 4 * floats.length);
    bytes.set(text);
    const view = new DataView(bytes.buffer);
    floats.forEach((float, i) => view.setFloat32(text.length + 4 * i, float, true));
    return checksumOf(bytes);
}

/** Demands that layers are of different kinds, in order, and share no attribute. */
function checkOrder(list: JsonCursor, layers: readonly Layer[]): void {
    if (layers.length === 0) list.reject('has no layer that can be read');
    for (let i = 1; i < layers.length; ++i) {
        const before = layers[i - 1];
        if (kTransports.indexOf(layers[i].transport) <= kTransports.indexOf(before.transport))
            list.reject('must be of different kinds, in the order of the format');
        if (layers[i].firstAttribute < before.firstAttribute + before.attributeCount)
            list.reject('must take attributes one after the other');
    }
}
