import { readFileSync } from 'node:fs';

import { joinGlb, openGlb } from './glb_file.js';

/** How a file is damaged, and what the library makes of it (tests/web/write_damaged_assets.cpp). */
export interface Damage {
    file: string;
    /** Bytes of the file that are others: place and value. */
    bytes?: [number, number][];
    /** Where it ends; further on there are zeros. */
    size?: number;
    /** Of the glTF's JSON, after which the file is put together again. */
    patch?: Operation[];
    /** Bytes of the binary chunk that are others. */
    binary?: [number, number][];
    /** One number a layer, or null where it is refused. */
    numbers: number[] | null;
}

/** Of RFC 6902. */
interface Operation {
    op: 'add' | 'remove' | 'replace';
    path: string;
    value?: unknown;
}

const originals = new Map<string, Uint8Array>();

function originalOf(file: string): Uint8Array {
    const folder = /^\d/.test(file) ? '../../../../tests/asset/golden' : '../assets';
    const bytes = originals.get(file) ?? new Uint8Array(readFileSync(new URL(`${folder}/${file}`, import.meta.url)));
    originals.set(file, bytes);
    return bytes;
}

export function damagedBytes({ file, bytes = [], size, patch, binary = [] }: Damage): Uint8Array {
    const original = originalOf(file);
    if (patch) {
        const glb = openGlb(original);
        glb.json = patch.reduce(applyOperation, glb.json);
        for (const [place, value] of binary) glb.binary[place] = value;
        return joinGlb(glb);
    }
    const damaged = new Uint8Array(size ?? original.length);
    damaged.set(original.subarray(0, damaged.length));
    for (const [place, value] of bytes) damaged[place] = value;
    return damaged;
}

function applyOperation(document: any, { op, path, value }: Operation): unknown {
    if (path === '') return value;
    const keys = path.slice(1).split('/').map((key) => key.replaceAll('~1', '/').replaceAll('~0', '~'));
    const last = keys.pop()!;
    const parent = keys.reduce((object, key) => object[key], document);
    if (Array.isArray(parent)) parent.splice(last === '-' ? parent.length : Number(last), op === 'add' ? 0 : 1, ...(op === 'remove' ? [] : [value]));
    else if (op === 'remove') delete parent[last];
    else parent[last] = value;
    return document;
}
