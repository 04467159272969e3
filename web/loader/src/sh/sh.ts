import type { Vec3 } from '../math.js';

/** Index of (l, m): l(l + 1) + m (C3). */
export function shIndex(l: number, m: number): number {
    return l * (l + 1) + m;
}

const normalizations: Float64Array[] = [];

/** K_lm √2, of m = 0 without the √2, with the sign (−1)^m, at index (l, m). */
function normalizationOf(bandCount: number): Float64Array {
    const cached = normalizations[bandCount];
    if (cached) return cached;
    const factors = new Float64Array(bandCount ** 2);
    for (let l = 0; l < bandCount; ++l) {
        let ratio = 1; // (l − m)! / (l + m)!
        for (let m = 0; m <= l; ++m) {
            if (m > 0) ratio /= (l + m) * (l - m + 1);
            const factor = Math.sqrt(((2 * l + 1) / (4 * Math.PI)) * ratio * (m > 0 ? 2 : 1)) * (m % 2 ? -1 : 1);
            factors[shIndex(l, m)] = factors[shIndex(l, -m)] = factor;
        }
    }
    return (normalizations[bandCount] = factors);
}

/**
 * Evaluates the basis (C2, C3): real, orthonormal, with the Condon-Shortley phase, +z its polar axis.
 *
 *   y_lm = (−1)^m √2 K_lm P_l^|m|(cos θ) · {cos mφ, sin |m|φ}
 *
 * By the recurrences of P_l^m / sin^m θ in l, and of sin^m θ {cos mφ, sin mφ} in m; no angle is computed.
 *
 * @param direction  unit
 * @param bandCount  n ≥ 1
 * @param values     n² numbers, written
 */
export function evaluateSh(direction: Vec3, bandCount: number, values: Float64Array = new Float64Array(bandCount ** 2)): Float64Array {
    const [x, y, z] = direction;
    const normalization = normalizationOf(bandCount);
    let cosine = 1; // sin^m θ cos mφ
    let sine = 0;
    let first = 1; // P_m^m / sin^m θ = (2m − 1)!!
    for (let m = 0; m < bandCount; ++m) {
        let before = 0;
        let legendre = first;
        for (let l = m; l < bandCount; ++l) {
            const up = shIndex(l, m);
            const down = shIndex(l, -m);
            values[up] = normalization[up] * legendre * cosine;
            if (m > 0) values[down] = normalization[down] * legendre * sine;
            const next = ((2 * l + 1) * z * legendre - (l + m) * before) / (l - m + 1);
            before = legendre;
            legendre = next;
        }
        first *= 2 * m + 1;
        [cosine, sine] = [x * cosine - y * sine, x * sine + y * cosine];
    }
    return values;
}
