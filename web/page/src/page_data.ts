import type { Vec3 } from 'openprt-three';

/** What `prt web` writes into the page (apps/prt/web.cpp), as JSON in the element `prt-data`. */
export interface PageData {
    assets: AssetEntry[];
    lights: LightEntry[];
}

/** From where an asset is seen at first. */
export interface View {
    /** World metres. */
    eye: Vec3;
    /** Unit. */
    forward: Vec3;
    verticalFovDegrees: number;
}

/** An asset; its bytes, a binary glTF, stand as base64 in the element `prt-asset-<index>`. */
export interface AssetEntry {
    name: string;
    camera: View;
}

/**
 * A light, and a small lat-long picture of it (C4) to be seen behind the scene: rows from the top of red, green and blue as 16-bit
 * floats, little endian, linear; they stand as base64 in the element `prt-light-<index>`.
 */
export interface LightEntry {
    name: string;
    /** What `prt light --format json` writes (parseLighting). */
    lighting: unknown;
    picture: { width: number; height: number };
}

/** What the page holds; of the page that prt has not filled in, nothing. */
export function readPageData(): PageData {
    const text = document.getElementById('prt-data')?.textContent;
    return text ? (JSON.parse(text) as PageData) : { assets: [], lights: [] };
}

/** The bytes of an element that holds base64, which is then emptied: a phone needs them once. */
export function takeBytes(id: string): Uint8Array<ArrayBuffer> {
    const element = document.getElementById(id);
    const text = atob(element?.textContent ?? '');
    if (element) element.textContent = '';
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    return bytes;
}
