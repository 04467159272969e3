import { DataTexture, FloatType, HalfFloatType, RGBAFormat, UnsignedByteType } from 'three';
import { HDRLoader } from 'three/addons/loaders/HDRLoader.js';
import { describe, expect, it } from 'vitest';

import { projectLatLong } from '../src/sh/project_lat_long.js';
import { projectTexture } from '../src/sh/project_texture.js';
import { reconstruct, scaleLighting } from '../src/sh/lighting.js';
import { lightDifference, lightOf, vectors } from './support/vectors.js';

/** A Radiance file whose upper half is red and bright, and whose lower half is blue. */
function makeHdr(width: number, height: number): ArrayBuffer {
    const header = new TextEncoder().encode(`#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y ${height} +X ${width}\n`);
    const bytes = new Uint8Array(header.length + 4 * width * height);
    bytes.set(header);
    for (let i = 0; i < width * height; ++i) bytes.set(i < (width * height) / 2 ? [128, 0, 0, 130] : [0, 0, 128, 129], header.length + 4 * i);
    return bytes.buffer;
}

describe('an environment that three.js loaded', () => {
    it.each([FloatType, HalfFloatType] as const)('by HDRLoader, of type %i, stands upright', (type) => {
        const loaded = new HDRLoader().setDataType(type).parse(makeHdr(4, 2)) as any;
        const texture = new DataTexture(loaded.data, loaded.width, loaded.height, RGBAFormat, loaded.type);
        texture.flipY = true; // as HDRLoader.load leaves it
        const lighting = projectTexture(texture, 3);
        const data = Array.from({ length: 24 }, (_, k) => (k < 12 ? [512 / 255, 0, 0] : [0, 0, 256 / 255])[k % 3]); // HDRLoader divides by 255
        expect(lightDifference(lighting, projectLatLong({ width: 4, height: 2, data, channelCount: 3 }, 3))).toBeLessThan(type === FloatType ? 1e-6 : 1e-3);
        expect(reconstruct(lighting, [0, 1, 0])[0]).toBeGreaterThan(reconstruct(lighting, [0, -1, 0])[0] + 1);
    });

    it.each(vectors.radiancePictures)('by HDRLoader is 256/255 as bright as the library reads it', ({ file, lighting }: any) => {
        const { data, width, height, type } = new HDRLoader().setDataType(FloatType).parse(new Uint8Array(Buffer.from(file, 'base64')).buffer) as any;
        const texture = new DataTexture(data, width, height, RGBAFormat, type);
        texture.flipY = true;
        const asBright = scaleLighting(projectTexture(texture, lighting.bands), [255 / 256, 255 / 256, 255 / 256]);
        expect(lightDifference(asBright, lightOf(lighting))).toBeLessThan(1e-5);
        expect(asBright.coefficients[0]).toBeGreaterThan(1);
    });

    it('without flipY, as EXRLoader leaves it, has its first row at the bottom', () => {
        const rows = new Float32Array([1, 0, 0, 1, 0, 0, 0, 1]);
        const texture = new DataTexture(rows, 1, 2, RGBAFormat, FloatType);
        expect(reconstruct(projectTexture(texture, 2), [0, -1, 0])[0]).toBeGreaterThan(0.9);
    });

    it('of bytes is refused, since those are not linear', () =>
        expect(() => projectTexture(new DataTexture(new Uint8Array(4), 1, 1, RGBAFormat, UnsignedByteType), 2)).toThrow('linear'));
});
