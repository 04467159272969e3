import { uniformLighting } from 'openprt-three';
import { describe, expect, it } from 'vitest';

import { readLightFile } from '../src/lights/light_file.js';
import { makePicture, pictureOfCoefficients, radianceOf, readPicture } from '../src/lights/light_picture.js';

const kRootOf4Pi = Math.sqrt(4 * Math.PI);
// three.js divides mantissas of .hdr by 255, not 256. Halves have ten bits and one that is understood.
const kRgbe = 1.01 / 255;
const kHalf = 2 ** -11;

/** A flat .hdr of one colour; rows of fewer than 8 pixels are never run-length encoded. */
function hdrOf(width: number, height: number, rgbe: number[]): ArrayBuffer {
    const header = new TextEncoder().encode(`#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y ${height} +X ${width}\n`);
    const file = new Uint8Array(header.length + 4 * width * height);
    file.set(header);
    for (let i = 0; i < width * height; ++i) file.set(rgbe, header.length + 4 * i);
    return file.buffer;
}

function textOf(json: unknown): ArrayBuffer {
    return new TextEncoder().encode(JSON.stringify(json)).buffer;
}

describe('a light from a file', () => {
    it('.hdr is projected, and shown as it is', () => {
        const light = readLightFile('room.hdr', hdrOf(4, 2, [128, 64, 32, 130])); // 2, 1, ½
        [2, 1, 0.5].forEach((radiance, channel) => {
            expect(Math.abs(light.lighting.coefficients[channel] / (kRootOf4Pi * radiance) - 1)).toBeLessThan(kRgbe);
            expect(Math.abs(radianceOf(light.picture, 3, 1)[channel] / radiance - 1)).toBeLessThan(kRgbe);
        });
        expect(light.lighting.bandCount).toBe(10);
    });

    it('.json is what prt writes', () => {
        const [l, half] = [kRootOf4Pi, kRootOf4Pi / 2];
        const light = readLightFile('a.json', textOf({ bands: 1, convention: 'cs', coefficients: [[l, l, half]] }));
        radianceOf(light.picture, 10, 10).forEach((value, channel) => expect(Math.abs(value - [1, 1, 0.5][channel])).toBeLessThan(kHalf));
    });

    it.each<[string, string, ArrayBuffer, RegExp]>([
        ['a square picture', 'a.hdr', hdrOf(4, 4, [1, 1, 1, 128]), /4 by 4 pixels, and a lat-long picture is twice as wide as high/],
        ['no picture', 'a.hdr', textOf('nothing'), /./],
        ['a cut picture', 'a.hdr', hdrOf(4, 2, [1, 1, 1, 128]).slice(0, -5), /./],
        ['no EXR', 'a.exr', textOf('nothing'), /./],
        ['no JSON', 'a.json', new TextEncoder().encode('{').buffer, /is not JSON/],
        ['other JSON', 'a.json', textOf([1, 2, 3]), /the coefficients of a light/],
        ['coefficients of another convention', 'a.json', textOf({ bands: 1, convention: 'three', coefficients: [[1, 1, 1]] }), /"three"/],
    ])('that is wrong is refused: %s', (_, name, bytes, sentence) => {
        expect(() => readLightFile(name, bytes)).toThrow(sentence);
    });
});

describe('the small picture of a light', () => {
    it('is read as it was written, row after row from the top', () => {
        const halves = new Uint16Array([0x3c00, 0x4000, 0x3800, 0, 0, 0x7bff]); // 1, 2, ½; 0, 0, 65504
        const picture = readPicture(new Uint8Array(halves.buffer), 1, 2);
        expect(radianceOf(picture, 0, 0)).toEqual([1, 2, 0.5]);
        expect(radianceOf(picture, 0, 1)).toEqual([0, 0, 65504]);
    });

    it('holds the largest half of what is more, and nothing below 0', () => {
        expect(radianceOf(makePicture(1, 1, () => [1e9, -1, 0.25]), 0, 0)).toEqual([65504, 0, 0.25]);
    });

    it('of coefficients has the radiance they stand for', () => {
        const picture = pictureOfCoefficients(uniformLighting([1, 2, 4], 4));
        expect(radianceOf(picture, 77, 33)).toEqual([1, 2, 4]);
    });
});
