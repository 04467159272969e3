import { OpenPrtError } from '../error.js';
import { JsonCursor } from './json_cursor.js';

/** What three.js's MeshoptDecoder has. */
export interface MeshoptDecoder {
    supported: boolean;
    ready: Promise<unknown>;
    decodeGltfBuffer(target: Uint8Array, count: number, size: number, source: Uint8Array, mode: string, filter?: string): void;
}

const kMeshopt = 'EXT_meshopt_compression';
// What a file may require: nothing of it changes the vertices.
const kUnderstood = new RegExp(
    '^(EXT_meshopt_compression|EXT_texture_(webp|avif)|KHR_texture_(transform|basisu)|KHR_mesh_quantization|' +
        'KHR_materials_\\w+|KHR_lights_punctual|OPENPRT_radiance_transfer)$',
);
// A byte of meshopt's is at most so many: runs of 16 equal bytes take two bits.
const kMostDecodedPerStored = 256;
// Each is hashed: a small file must not keep a reader busy.
const kMostViewsOfAByte = 64;

const kComponentBytes: Readonly<Record<number, number>> = { 5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4 };
const kComponentsOfType: Readonly<Record<string, number>> = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT2: 4, MAT3: 9, MAT4: 16 };

/** What an accessor must be. */
export interface AccessorForm {
    type: string;
    componentType: number;
    normalized: boolean;
    count: number;
}

interface BufferView {
    place: JsonCursor;
    stored: Uint8Array;
    byteOffset: number;
    byteLength: number;
    stride: number;
    /** What EXT_meshopt_compression says; `bytes` are then decoded on first use. */
    packing: { count: number; mode: string; filter: string } | undefined;
    bytes: Uint8Array | undefined;
}

/** A glTF whose parts are checked before they are used. */
export class GltfDocument {
    readonly root: JsonCursor;
    readonly accessors: JsonCursor[];
    private readonly views: BufferView[];

    /**
     * @param json     the glTF's JSON
     * @param buffers  the bytes of its buffers; of one that EXT_meshopt_compression leaves empty, none
     * @param decoder  of encoded buffer views, ready; may be left out where there are none
     */
    constructor(
        json: unknown,
        buffers: readonly (Uint8Array | undefined)[],
        private readonly decoder?: MeshoptDecoder,
    ) {
        this.root = new JsonCursor(json, 'glTF');
        this.checkVersion();
        const sizes = this.list('buffers').map((buffer) => {
            buffer.find('extensions')?.find(kMeshopt)?.find('fallback')?.toFlag();
            return buffer.at('byteLength').toCount(1);
        });
        sizes.forEach((size, i) => {
            const bytes = buffers[i];
            if (bytes && bytes.byteLength < size)
                throw new OpenPrtError('malformed', `buffer ${i} has ${bytes.byteLength} bytes, and says that it has ${size}`);
        });
        this.views = this.list('bufferViews').map((view) => parseView(view, sizes, buffers));
        this.accessors = this.list('accessors');
        const bufferBytes = sizes.reduce((sum, size) => sum + size, 0);
        if (this.storedBytes() > kMostViewsOfAByte * bufferBytes)
            throw new OpenPrtError('malformed', 'the buffer views of the file are the same bytes over and over');
    }

    list(key: string): JsonCursor[] {
        return this.root.find(key)?.elements() ?? [];
    }

    /** The bytes as stored of all buffer views. */
    storedViews(): Uint8Array[] {
        return this.views.map((view) => view.stored);
    }

    /** The number of an accessor's elements; those are there. */
    countOf(index: number): number {
        return this.accessor(index).at('count').toCount(1);
    }

    /** The form of an accessor as it says it. */
    formOf(index: number): AccessorForm {
        const accessor = this.accessor(index);
        return {
            type: accessor.at('type').toText(),
            componentType: accessor.at('componentType').toCount(),
            normalized: accessor.find('normalized')?.toFlag() ?? false,
            count: this.countOf(index),
        };
    }

    /**
     * The elements of an accessor in order, tightly packed.
     *
     * @param form  that it must have
     * @returns     a view of the file's bytes where they are packed; else a copy
     */
    elementsOf(index: number, form: AccessorForm): Uint8Array {
        const accessor = this.accessor(index);
        const own = this.formOf(index);
        if (own.type !== form.type || own.componentType !== form.componentType || own.normalized !== form.normalized)
            accessor.reject('has another form than its use demands');
        if (own.count !== form.count) accessor.reject(`has another number of elements than ${form.count}`);
        const size = kComponentBytes[own.componentType] * kComponentsOfType[own.type];
        const alignment = kComponentBytes[own.componentType];
        const packed = accessor.find('bufferView') ? this.slicePacked(accessor, size, own.count, alignment) : undefined;
        const sparse = accessor.find('sparse');
        if (packed && !sparse) return packed;
        // Zeros, where there is no buffer view, but not without end.
        if (!packed && size * own.count > kMostDecodedPerStored * this.storedBytes()) accessor.reject('has more elements than the file has bytes for');
        const replaced = packed?.slice() ?? new Uint8Array(size * own.count);
        if (sparse) this.replaceSparse(sparse, replaced, size, own.count, alignment);
        return replaced;
    }

    /** `count` elements of an accessor, or of an array of a sparse one. */
    private slicePacked(place: JsonCursor, size: number, count: number, alignment: number): Uint8Array {
        const view = this.view(place.at('bufferView'));
        const begin = place.find('byteOffset')?.toCount() ?? 0;
        const stride = view.stride || size;
        if (stride < size) place.reject('has elements larger than the stride of its buffer view');
        if ((view.byteOffset + begin) % alignment !== 0) place.reject('is not aligned to its numbers');
        if (begin + stride * (count - 1) + size > view.byteLength) place.reject('ends behind its buffer view');
        const bytes = this.bytesOf(view);
        if (stride === size) return bytes.subarray(begin, begin + size * count);
        const packed = new Uint8Array(size * count);
        for (let i = 0; i < count; ++i) packed.set(bytes.subarray(begin + i * stride, begin + i * stride + size), i * size);
        return packed;
    }

    private replaceSparse(sparse: JsonCursor, elements: Uint8Array, size: number, count: number, alignment: number): void {
        const replacedCount = sparse.at('count').toCount(1, count);
        const indices = sparse.at('indices');
        const indexSize = ({ 5121: 1, 5123: 2, 5125: 4 } as Record<number, number>)[indices.at('componentType').toCount()];
        if (!indexSize) indices.at('componentType').reject('is no type of indices');
        const stored = this.slicePacked(indices, indexSize, replacedCount, indexSize);
        const values = this.slicePacked(sparse.at('values'), size, replacedCount, alignment);
        for (let i = 0, before = -1; i < replacedCount; ++i) {
            let index = 0;
            for (let byte = indexSize - 1; byte >= 0; --byte) index = index * 256 + stored[i * indexSize + byte];
            if (index <= before || index >= count) indices.reject('must ascend, and name elements that are there');
            elements.set(values.subarray(i * size, (i + 1) * size), index * size);
            before = index;
        }
    }

    /** What all buffer views hold, once decoded. */
    viewBytes(): number {
        return this.views.reduce((sum, view) => sum + view.byteLength, 0);
    }

    private storedBytes(): number {
        return this.views.reduce((sum, view) => sum + view.stored.length, 0);
    }

    private checkVersion(): void {
        const asset = this.root.at('asset');
        if (!/^2\.[0-9]+$/.test(asset.at('version').toText()))
            throw new OpenPrtError('unsupported', `the file is glTF ${asset.at('version').toText()}, and this reader knows 2.0`);
        if ((asset.find('minVersion')?.toText() ?? '2.0') !== '2.0')
            throw new OpenPrtError('unsupported', 'the file asks for a reader of a later version than glTF 2.0');
        this.list('extensionsUsed').forEach((name) => name.toText());
        for (const name of this.list('extensionsRequired'))
            if (!kUnderstood.test(name.toText()))
                throw new OpenPrtError('unsupported', `the file requires ${name.toText()}, which this reader does not know`);
    }

    private accessor(index: number): JsonCursor {
        const accessor = this.accessors[index];
        if (!accessor) throw new OpenPrtError('malformed', `accessor ${index} is not there`);
        const type = accessor.at('type').toText();
        if (!Object.hasOwn(kComponentsOfType, type)) accessor.at('type').reject('is no type of accessors');
        if (!Object.hasOwn(kComponentBytes, accessor.at('componentType').toCount()))
            accessor.at('componentType').reject('is no type of components');
        return accessor;
    }

    private view(reference: JsonCursor): BufferView {
        return this.views[reference.toCount()] ?? reference.reject('is no buffer view');
    }

    private bytesOf(view: BufferView): Uint8Array {
        if (view.bytes) return view.bytes;
        const { count, mode, filter } = view.packing!;
        if (!this.decoder)
            throw new OpenPrtError('unsupported', `the file is encoded by ${kMeshopt}, and no decoder of it was given`);
        const bytes = new Uint8Array(view.byteLength);
        try {
            this.decoder.decodeGltfBuffer(bytes, count, view.byteLength / count, view.stored, mode, filter);
        } catch {
            view.place.reject('cannot be decoded');
        }
        return (view.bytes = bytes);
    }
}

/** A piece of a buffer, which must hold it; nothing where the buffer has no bytes. */
function slice(object: JsonCursor, sizes: readonly number[], buffers: readonly (Uint8Array | undefined)[]): Uint8Array | undefined {
    const buffer = object.at('buffer').toCount();
    const begin = object.find('byteOffset')?.toCount() ?? 0;
    const length = object.at('byteLength').toCount(1);
    if (!(buffer < sizes.length)) object.at('buffer').reject('is no buffer');
    if (begin + length > sizes[buffer]) object.reject('ends behind its buffer');
    return buffers[buffer]?.subarray(begin, begin + length);
}

function parseView(place: JsonCursor, sizes: readonly number[], buffers: readonly (Uint8Array | undefined)[]): BufferView {
    const byteOffset = place.find('byteOffset')?.toCount() ?? 0;
    const byteLength = place.at('byteLength').toCount(1);
    const stride = place.find('byteStride')?.toCount(4, 252) ?? 0;
    if (stride % 4 !== 0) place.at('byteStride').reject('must be a multiple of 4');
    const own = slice(place, sizes, buffers);
    const packing = place.find('extensions')?.find(kMeshopt);
    if (!packing) {
        const bytes = own ?? place.at('buffer').reject('has no bytes');
        return { place, stored: bytes, byteOffset, byteLength, stride, packing: undefined, bytes };
    }
    const stored = slice(packing, sizes, buffers) ?? packing.at('buffer').reject('has no bytes');
    const count = packing.at('count').toCount(1);
    if (packing.at('byteStride').toCount(1, 256) * count !== byteLength)
        packing.reject('does not fit the length of its buffer view');
    if (byteLength > kMostDecodedPerStored * stored.length) packing.reject('promises more than its bytes can hold');
    return {
        place, stored, byteOffset, byteLength, stride, bytes: undefined,
        packing: { count, mode: packing.at('mode').toText(), filter: packing.find('filter')?.toText() ?? 'NONE' },
    };
}
