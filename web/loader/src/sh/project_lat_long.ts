import { OpenPrtError } from '../error.js';
import { type Mat3, gaussLegendre } from '../math.js';
import { type Lighting, darkness } from './lighting.js';
import { rotateLighting } from './rotate.js';
import { evaluateSh, shIndex } from './sh.js';

/** A lat-long picture of radiance, linear (C4, C5). A THREE.DataTexture's image is one, whose first row may be the bottom. */
export interface LatLongImage {
    width: number;
    height: number;
    /** Row after row from the top, `channelCount` numbers a texel, of which the first three are red, green, blue. */
    data: ArrayLike<number>;
    /** 3 or 4. */
    channelCount: number;
    /** Rows go from the bottom to the top. */
    isUpsideDown?: boolean;
}

// Takes what stands about +z to stand about +y: (x, y, z) to (x, z, y), a reflection, since azimuth goes from +x towards +z.
const kExchangeYz: Mat3 = [1, 0, 0, 0, 0, 1, 0, 1, 0];

/**
 * Projects an environment as if each of its texels were constant, exactly: a texel weighs the integral of y_i over it.
 *
 *   L_i = Σ over texels of L · ∫ y_i(ω) dω over the texel                                        [Ramamoorthi01, eq. 3]
 *
 * About the axis +y the integral is a product of one of azimuth and one of polar angle, so a row costs 2n − 1 sums.
 *
 * @throws OpenPrtError  where a texel is not finite, or the array is too short
 */
export function projectLatLong(image: LatLongImage, bandCount: number): Lighting {
    const { width, height, data, channelCount } = image;
    if (!(width > 0 && height > 0) || data.length < width * height * channelCount)
        throw new OpenPrtError('invalidOption', `a picture of ${width} by ${height} texels has too few numbers`);
    const azimuths = integrateAzimuths(width, bandCount);
    const upright = darkness(bandCount);
    const sums = new Float64Array(3 * azimuths.length);
    const quadrature = gaussLegendre(bandCount + 12);
    for (let row = 0; row < height; ++row) {
        const texels = (image.isUpsideDown ? height - 1 - row : row) * width * channelCount;
        sums.fill(0);
        for (let k = 0; k < azimuths.length; ++k)
            for (let column = 0; column < width; ++column)
                for (let channel = 0; channel < 3; ++channel)
                    sums[3 * k + channel] += data[texels + column * channelCount + channel] * azimuths[k][column];
        const polar = integratePolar((Math.PI * row) / height, (Math.PI * (row + 1)) / height, bandCount, quadrature);
        for (let l = 0; l < bandCount; ++l)
            for (let m = -l; m <= l; ++m)
                for (let channel = 0; channel < 3; ++channel)
                    upright.coefficients[3 * shIndex(l, m) + channel] += polar[shIndex(l, Math.abs(m))] * sums[3 * (bandCount - 1 + m) + channel];
    }
    if (!upright.coefficients.every(Number.isFinite)) throw new OpenPrtError('malformed', 'a texel of the environment is not finite');
    return rotateLighting(upright, kExchangeYz);
}

/** ∫ cos mφ dφ of m ≥ 0 and ∫ sin |m|φ dφ of m < 0 over each column, at index m + n − 1. Column 0 begins at φ = −π. */
function integrateAzimuths(width: number, bandCount: number): Float64Array[] {
    return Array.from({ length: 2 * bandCount - 1 }, (_, k) => {
        const m = k - (bandCount - 1);
        return Float64Array.from({ length: width }, (_, column) => {
            const begin = 2 * Math.PI * (column / width - 0.5);
            const end = 2 * Math.PI * ((column + 1) / width - 0.5);
            if (m === 0) return end - begin;
            return m > 0 ? (Math.sin(m * end) - Math.sin(m * begin)) / m : (Math.cos(m * end) - Math.cos(m * begin)) / m;
        });
    });
}

/** ∫ y_lm(θ, φ = 0) sin θ dθ of m ≥ 0, from one polar angle to another; exact to rounding, since the integrand has few waves. */
function integratePolar(begin: number, end: number, bandCount: number, { nodes, weights }: ReturnType<typeof gaussLegendre>): Float64Array {
    const sums = new Float64Array(bandCount ** 2);
    const values = new Float64Array(bandCount ** 2);
    nodes.forEach((node, i) => {
        const theta = begin + ((node + 1) / 2) * (end - begin);
        evaluateSh([Math.sin(theta), 0, Math.cos(theta)], bandCount, values);
        const weight = (weights[i] * (end - begin) * Math.sin(theta)) / 2;
        for (let k = 0; k < sums.length; ++k) sums[k] += weight * values[k];
    });
    return sums;
}
