import { type Vec3, parseLighting, projectLatLong } from 'openprt-three';
import { FloatType } from 'three';
import { EXRLoader } from 'three/addons/loaders/EXRLoader.js';
import { HDRLoader } from 'three/addons/loaders/HDRLoader.js';

import { makePicture, pictureOfCoefficients } from './light_picture.js';
import { Light } from './lights.js';

const kBandCount = 10;
const kPictureHeight = 128;
const kMostTexels = 2 ** 26;

/** Radiance in floats, four numbers a texel. */
interface Environment {
    width: number;
    height: number;
    data: Float32Array;
    isUpsideDown: boolean;
}

/** What three.js's loaders return. */
interface TexData {
    width?: number | undefined;
    height?: number | undefined;
    data?: unknown;
}

/** A light from a file: a lat-long picture, NAME.hdr or NAME.exr, or coefficients as `prt light --format json` writes them. */
export function readLightFile(name: string, bytes: ArrayBuffer): Light {
    if (/\.json$/i.test(name)) {
        const lighting = parseLighting(parseJson(bytes));
        return new Light(name, lighting, pictureOfCoefficients(lighting));
    }
    const environment = /\.exr$/i.test(name) ? readExr(bytes) : readHdr(bytes);
    const { width, height } = environment;
    if (width !== 2 * height) throw new Error(`it has ${width} by ${height} pixels, and a lat-long picture is twice as wide as high`);
    const lighting = projectLatLong({ ...environment, channelCount: 4 }, kBandCount);
    return new Light(name, lighting, shrink(environment));
}

function parseJson(bytes: ArrayBuffer): unknown {
    try {
        return JSON.parse(new TextDecoder().decode(bytes));
    } catch {
        throw new Error('it is not JSON');
    }
}

function readHdr(bytes: ArrayBuffer): Environment {
    return check(new HDRLoader().setDataType(FloatType).parse(bytes), false);
}

function readExr(bytes: ArrayBuffer): Environment {
    return check(new EXRLoader().setDataType(FloatType).parse(bytes), true);
}

function check({ width = 0, height = 0, data }: TexData, isUpsideDown: boolean): Environment {
    if (!(width > 0 && height > 0) || width * height > kMostTexels || !(data instanceof Float32Array) || data.length < 4 * width * height)
        throw new Error(`it says that it has ${width} by ${height} pixels, which cannot be`);
    return { width, height, data, isUpsideDown };
}

/** The means of blocks of texels. */
function shrink({ width, height, data, isUpsideDown }: Environment): ReturnType<typeof makePicture> {
    const rows = Math.min(kPictureHeight, height);
    const columns = 2 * rows;
    return makePicture(columns, rows, (column, row): Vec3 => {
        const sum: [number, number, number] = [0, 0, 0];
        const [left, right] = [column, column + 1].map((edge) => Math.floor((edge * width) / columns));
        const [top, bottom] = [row, row + 1].map((edge) => Math.floor((edge * height) / rows));
        for (let y = top; y < bottom; ++y)
            for (let x = left; x < right; ++x)
                for (let channel = 0; channel < 3; ++channel) sum[channel] += data[4 * ((isUpsideDown ? height - 1 - y : y) * width + x) + channel];
        const count = (right - left) * (bottom - top);
        return [sum[0] / count, sum[1] / count, sum[2] / count];
    });
}
