import { checksumOf } from '../../src/asset/crc32.js';
import { splitGlb } from '../../src/asset/glb.js';

/** A binary glTF that is taken apart to be changed. */
export interface GlbFile {
    json: any;
    binary: Uint8Array;
}

export function openGlb(bytes: Uint8Array): GlbFile {
    const { json, binary } = splitGlb(bytes);
    return { json, binary: binary.slice() };
}

export function joinGlb({ json, binary }: GlbFile): Uint8Array {
    const text = new TextEncoder().encode(JSON.stringify(json));
    const jsonSize = Math.ceil(text.length / 4) * 4;
    const bytes = new Uint8Array(12 + 8 + jsonSize + 8 + binary.length).fill(0x20);
    const view = new DataView(bytes.buffer);
    [0x46546c67, 2, bytes.length, jsonSize, 0x4e4f534a].forEach((word, i) => view.setUint32(4 * i, word, true));
    bytes.set(text, 20);
    view.setUint32(20 + jsonSize, binary.length, true);
    view.setUint32(24 + jsonSize, 0x004e4942, true);
    bytes.set(binary, 28 + jsonSize);
    return bytes;
}

export const headerOf = (file: GlbFile): any => file.json.extensions.OPENPRT_radiance_transfer;
export const layerOf = (file: GlbFile, layer: number): any => headerOf(file).layers[layer];
export const clustersOf = (file: GlbFile): any => layerOf(file, 1).clusters;
export const primitiveOf = (file: GlbFile, mesh: number): any => file.json.meshes[mesh].primitives[0];
export const boundOf = (file: GlbFile, mesh: number): any => primitiveOf(file, mesh).extensions.OPENPRT_radiance_transfer.checksums;

export function viewBytes(file: GlbFile, view: number): Uint8Array {
    const { byteOffset = 0, byteLength } = file.json.bufferViews[view];
    return file.binary.subarray(byteOffset, byteOffset + byteLength);
}

const kComponents: Record<string, number> = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 };
const kBytes: Record<number, number> = { 5121: 1, 5123: 2, 5125: 4, 5126: 4 };

/** The bytes of a packed accessor, in place. */
export function accessorBytes(file: GlbFile, index: number): Uint8Array {
    const { bufferView, byteOffset = 0, count, type, componentType } = file.json.accessors[index];
    return viewBytes(file, bufferView).subarray(byteOffset, byteOffset + count * kComponents[type] * kBytes[componentType]);
}

/** Writes the checksums anew, wherever what they guard can be found: a forger's work. */
export function repairChecksums(file: GlbFile): void {
    const attempt = (repair: () => void): void => {
        try {
            repair();
        } catch {
            // What makes no sense has no checksum.
        }
    };
    const header = headerOf(file);
    file.json.bufferViews.forEach((_: unknown, i: number) =>
        attempt(() => {
            if (i < header.checksums.length) header.checksums[i] = checksumOf(viewBytes(file, i));
        }),
    );
    for (const mesh of file.json.meshes)
        for (const { attributes, extensions } of mesh.primitives)
            for (const name of Object.keys(extensions?.OPENPRT_radiance_transfer?.checksums ?? {}))
                attempt(() => {
                    extensions.OPENPRT_radiance_transfer.checksums[name] = checksumOf(accessorBytes(file, attributes[name]));
                });
    attempt(() => header.layers.forEach((layer: unknown) => attempt(() => repairLayer(file, layer))));
}

function repairLayer(file: GlbFile, layer: any): void {
    const { clusters } = layer;
    if (clusters) clusters.checksum = checksumOf(accessorBytes(file, clusters.accessor));
    let text = `${layer.transport} ${layer.encoding} ${layer.channels} ${headerOf(file).bands} ${layer.attributes.first} ${layer.attributes.count}`;
    if (layer.transport.startsWith('glossy')) text += ` ${layer.incidentBands}`;
    if (clusters) text += ` ${clusters.weights} ${clusters.encoding} ${clusters.checksum} ${clusters.components.join(' ')}`;
    const { scale = [], bias = [] } = clusters ?? layer;
    const floats = new Float32Array([...scale, ...bias, ...(layer.largestError === undefined ? [] : [layer.largestError])]);
    layer.checksum = checksumOf(new Uint8Array([...new TextEncoder().encode(text), ...new Uint8Array(floats.buffer)]));
}
