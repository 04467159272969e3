import { inflateSync } from 'node:zlib';

/** sRGB code values, rows from the top, of red, green and blue. */
export interface Picture {
    width: number;
    height: number;
    data: Uint8Array;
}

/** Reads a PNG of 8 bits, with or without alpha, as prt and Chromium write them (PNG, third edition, 9 and 12). */
export function readPng(file: Uint8Array): Picture {
    const bytes = Buffer.from(file.buffer, file.byteOffset, file.byteLength);
    const [width, height] = [bytes.readUInt32BE(16), bytes.readUInt32BE(20)];
    const [depth, colorType, , , interlace] = bytes.subarray(24, 29);
    const channelCount = { 2: 3, 6: 4 }[colorType];
    if (depth !== 8 || !channelCount || interlace !== 0) throw new Error('a PNG of 8 bits, red, green and blue, was expected');
    const parts: Buffer[] = [];
    for (let at = 8; at < bytes.length; at += 12 + bytes.readUInt32BE(at))
        if (bytes.toString('latin1', at + 4, at + 8) === 'IDAT') parts.push(bytes.subarray(at + 8, at + 8 + bytes.readUInt32BE(at)));
    const stride = channelCount * width;
    const rows = unfilter(inflateSync(Buffer.concat(parts)), height, stride, channelCount);
    return { width, height, data: Uint8Array.from({ length: 3 * width * height }, (_, i) => rows[channelCount * Math.floor(i / 3) + (i % 3)]) };
}

function unfilter(filtered: Uint8Array, height: number, stride: number, channelCount: number): Uint8Array {
    const rows = new Uint8Array(height * stride);
    for (let y = 0; y < height; ++y) {
        const kind = filtered[y * (stride + 1)];
        for (let x = 0; x < stride; ++x) {
            const at = y * stride + x;
            const left = x >= channelCount ? rows[at - channelCount] : 0;
            const up = y > 0 ? rows[at - stride] : 0;
            const upLeft = x >= channelCount && y > 0 ? rows[at - stride - channelCount] : 0;
            rows[at] = filtered[at + y + 1] + guess(kind, left, up, upLeft);
        }
    }
    return rows;
}

function guess(kind: number, left: number, up: number, upLeft: number): number {
    switch (kind) {
        case 1: return left;
        case 2: return up;
        case 3: return (left + up) >> 1;
        case 4: {
            const [a, b, c] = [Math.abs(up - upLeft), Math.abs(left - upLeft), Math.abs(left + up - 2 * upLeft)];
            return a <= b && a <= c ? left : b <= c ? up : upLeft;
        }
        default: return 0;
    }
}

/** The part from column x to that before x + width. */
export function crop(picture: Picture, x: number, width: number): Picture {
    const data = new Uint8Array(3 * width * picture.height);
    for (let y = 0; y < picture.height; ++y)
        data.set(picture.data.subarray(3 * (y * picture.width + x), 3 * (y * picture.width + x + width)), 3 * y * width);
    return { width, height: picture.height, data };
}

/** How alike two pictures are, in decibels: peak signal to noise over code values of sRGB, which are about as far apart as they look. */
export interface Likeness {
    whole: number;
    /** Where the truth is smooth: at edges sixteen rays a pixel and multisampling see other shares of what meets there. */
    smooth: number;
    /** How much of the picture that is. */
    smoothPart: number;
}

export function compare(seen: Picture, truth: Picture): Likeness {
    if (seen.width !== truth.width || seen.height !== truth.height)
        throw new Error(`the pictures are of ${seen.width}x${seen.height} and ${truth.width}x${truth.height}`);
    let [whole, smooth, count] = [0, 0, 0];
    for (let y = 0; y < truth.height; ++y)
        for (let x = 0; x < truth.width; ++x) {
            const at = 3 * (y * truth.width + x);
            let squares = 0;
            for (let channel = 0; channel < 3; ++channel) squares += (seen.data[at + channel] - truth.data[at + channel]) ** 2;
            whole += squares;
            if (!isSmooth(truth, x, y)) continue;
            smooth += squares;
            ++count;
        }
    const pixelCount = truth.width * truth.height;
    return { whole: decibels(whole / pixelCount), smooth: decibels(smooth / count), smoothPart: count / pixelCount };
}

/** @param error  sum of the squared differences of three channels */
const decibels = (error: number): number => 10 * Math.log10(255 ** 2 / Math.max(error / 3, 1e-6));

/** Whether the pixel and its eight neighbours differ by less than what shading alone does. */
function isSmooth({ width, height, data }: Picture, x: number, y: number): boolean {
    const kLeastStep = 8;
    const at = 3 * (y * width + x);
    for (let v = Math.max(y - 1, 0); v <= Math.min(y + 1, height - 1); ++v)
        for (let u = Math.max(x - 1, 0); u <= Math.min(x + 1, width - 1); ++u)
            for (let channel = 0; channel < 3; ++channel)
                if (Math.abs(data[3 * (v * width + u) + channel] - data[at + channel]) >= kLeastStep) return false;
    return true;
}
