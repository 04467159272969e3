/** Kinds of light transport, in the order of an asset's layers. The last two are matrices. */
export const kTransports = ['unshadowed', 'shadowed', 'interreflected', 'glossy-shadowed', 'glossy'] as const;
export type Transport = (typeof kTransports)[number];

export type Encoding = 'float32' | 'unorm16' | 'unorm8';
export type StoredArray = Float32Array | Uint16Array | Uint8Array;

/** How a coefficient is stored: value = bias + scale · q / largest; both arrays are empty of floats. */
export interface Storage {
    encoding: Encoding;
    scale: Float32Array;
    bias: Float32Array;
}

/** The vectors that the vertices of a cluster share. */
export interface Clusters {
    /** P_k of each cluster. */
    componentCounts: readonly number[];
    /** The largest of them. */
    componentCount: number;
    /** Row of b_k0 in `vectors`; b_kp stands p rows below. */
    firstRows: readonly number[];
    storage: Storage;
    accessor: number;
    checksum: string;
    /** Rows of K coefficients, decoded. */
    vectors: Float32Array;
}

/** One kind of transport, in full, of all vertices. */
export interface Layer {
    transport: Transport;
    channelCount: 1 | 3;
    /** n_in of matrices; 0 of vectors. */
    incidentBandCount: number;
    /** K: how many coefficients a vertex has. */
    coefficientCount: number;
    /** N: how many numbers a vertex stores. */
    numberCount: number;
    /** Its attributes are _PRT_first, and so on. */
    firstAttribute: number;
    attributeCount: number;
    /** Of the vertices' numbers; where there are clusters, of cluster and weights, without scale and bias. */
    storage: Storage;
    clusters?: Clusters;
    /** How far a coefficient may be from what was baked; 0 where it is not said. */
    largestError: number;
}

export function isGlossy(transport: Transport): boolean {
    return transport === 'glossy-shadowed' || transport === 'glossy';
}

/** What q is divided by; 1 of floats. */
export function largestStored(encoding: Encoding): number {
    return encoding === 'float32' ? 1 : encoding === 'unorm16' ? 65535 : 255;
}

export function bytesPerNumber(encoding: Encoding): number {
    return encoding === 'float32' ? 4 : encoding === 'unorm16' ? 2 : 1;
}

/** An array over bytes that were checked to be whole numbers of that encoding; copies where they are not aligned. */
export function arrayOver(encoding: Encoding, bytes: Uint8Array): StoredArray {
    if (encoding === 'unorm8') return bytes;
    const size = bytesPerNumber(encoding);
    const aligned = bytes.byteOffset % size === 0 ? bytes : bytes.slice();
    const count = aligned.byteLength / size;
    return encoding === 'float32'
        ? new Float32Array(aligned.buffer, aligned.byteOffset, count)
        : new Uint16Array(aligned.buffer, aligned.byteOffset, count);
}
