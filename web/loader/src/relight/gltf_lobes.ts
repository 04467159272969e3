import { type Vec3, gaussLegendre } from '../math.js';
import { evaluateSh, shIndex } from '../sh/sh.js';

/** How many views a table has, from the normal on, evenly in √(1 − cos θ), which is about as the angle and exact in every shader. */
export const kViewCount = 32;
/** Of the last view, almost at the horizon, where lobes are not defined. */
export const kMostViewPlace = 0.992;

const kLeastAlpha = 0.002;
const kHorizonWeight = 0.01;

/**
 * What the three lobes of glTF's metallic-roughness material make of incident radiance, for views at azimuth 0:
 *
 *   f_i(ω_o) = ∫ f_r(ω′, ω_o) max(ω′_z, 0) y_i(ω′) dω′
 *
 * of GGX with F0 = 0 and F0 = 1, and of a Lambert lobe of albedo 1 under a layer with F0 = 0. Schlick's F is linear in F0, and a
 * dielectric's F0 is 0.04, so that with K, B and D of a view a surface of metallic m reflects
 *
 *   baseColor · ((1 − m) 0.96 D + m (B − K))  +  K + 0.04 (1 − m)(B − K)
 *
 * They are fitted for radiance that is 0 below the horizon: (0.99 H + 0.01)⁻¹ f, H_ij = ∫ y_i y_j over the upper hemisphere [Sloan03].
 *
 * @returns  K, B, D and a zero for (l, m ≥ 0) of a view at 4 (view · n(n + 1)/2 + l(l + 1)/2 + m)
 */
export function makeLobeTable(roughness: number, bandCount: number): Float32Array {
    const alpha = Math.max(roughness * roughness, kLeastAlpha);
    const uprightCount = (bandCount * (bandCount + 1)) / 2;
    const table = new Float32Array(4 * uprightCount * kViewCount);
    const fit = fitOf(bandCount);
    for (let view = 0; view < kViewCount; ++view) {
        const lobes = [...projectSpecular(viewOf(view), alpha, bandCount).map(fit), diffuseOf(bandCount)[view]];
        for (let l = 0; l < bandCount; ++l)
            for (let m = 0; m <= l; ++m)
                lobes.forEach((lobe, k) => (table[4 * (view * uprightCount + (l * (l + 1)) / 2 + m) + k] = lobe[shIndex(l, m)]));
    }
    return table;
}

function viewOf(view: number): Vec3 {
    const cosine = 1 - ((kMostViewPlace * view) / (kViewCount - 1)) ** 2;
    return [Math.sqrt(1 - cosine * cosine), 0, cosine];
}

/** K and B of one view. */
function projectSpecular(wo: Vec3, alpha: number, bandCount: number): Float64Array[] {
    const lobes = [new Float64Array(bandCount ** 2), new Float64Array(bandCount ** 2)];
    const values = new Float64Array(bandCount ** 2);
    // Half vectors as GGX spreads them.
    visitRule(48, (u, phi, weight) => {
        const cosine = Math.sqrt((1 - u) / (1 + (alpha * alpha - 1) * u));
        const sine = Math.sqrt(1 - cosine * cosine);
        const h: Vec3 = [sine * Math.cos(phi), sine * Math.sin(phi), cosine];
        const oh = wo[0] * h[0] + wo[2] * h[2];
        const wi: Vec3 = [2 * oh * h[0] - wo[0], 2 * oh * h[1], 2 * oh * h[2] - wo[2]];
        if (oh <= 0 || wi[2] <= 0) return;
        const smith = (a: number, b: number): number => a * Math.sqrt(b * b * (1 - alpha * alpha) + alpha * alpha);
        const visibility = 0.5 / (smith(wi[2], wo[2]) + smith(wo[2], wi[2]));
        const all = ((visibility * wi[2] * 4 * oh) / cosine) * weight;
        addScaled(lobes[0], all * (1 - oh) ** 5, evaluateSh(wi, bandCount, values));
        addScaled(lobes[1], all, values);
    });
    return lobes;
}

const diffuseLobes: Float64Array[][] = [];

/** D of each view, fitted; no roughness changes it. */
function diffuseOf(bandCount: number): Float64Array[] {
    return (diffuseLobes[bandCount] ??= Array.from({ length: kViewCount }, (_, view) => {
        const wo = viewOf(view);
        const lobe = new Float64Array(bandCount ** 2);
        visitRule(16, (z, phi, weight) => {
            const sine = Math.sqrt(1 - z * z);
            const wi: Vec3 = [sine * Math.cos(phi), sine * Math.sin(phi), z];
            const oh = Math.sqrt((1 + wi[0] * wo[0] + z * wo[2]) / 2); // cosine of half the angle between them
            addScaled(lobe, 2 * z * (1 - (1 - oh) ** 5) * weight, evaluateSh(wi, bandCount));
        });
        return fitOf(bandCount)(lobe);
    }));
}

function addScaled(sum: Float64Array, weight: number, values: Float64Array): void {
    for (let i = 0; i < sum.length; ++i) sum[i] += weight * values[i];
}

const kAzimuthCount = 16;

/** Visits u in (0, 1) and azimuths in (0, π), whose weights add to 1: what views at azimuth 0 see is the same on both sides. */
function visitRule(count: number, visit: (u: number, phi: number, weight: number) => void): void {
    const { nodes, weights } = gaussLegendre(count);
    nodes.forEach((node, i) => {
        for (let k = 0; k < kAzimuthCount; ++k) visit((node + 1) / 2, (Math.PI * (k + 0.5)) / kAzimuthCount, weights[i] / 2 / kAzimuthCount);
    });
}

type Fit = (coefficients: Float64Array) => Float64Array;

const fits: Fit[] = [];

function fitOf(bandCount: number): Fit {
    return (fits[bandCount] ??= makeHorizonFit(bandCount));
}

/** Solves ((1 − ε) H + ε) f̃ = f, for each m by itself. */
function makeHorizonFit(bandCount: number): Fit {
    const { nodes, weights } = gaussLegendre(bandCount);
    const values = Array.from(nodes, (node) => {
        const z = (node + 1) / 2;
        return evaluateSh([Math.sqrt(1 - z * z), 0, z], bandCount);
    });
    const matrixOf = (m: number): number[][] =>
        Array.from({ length: bandCount - m }, (_, row) =>
            Array.from({ length: bandCount - m }, (_, column) => {
                let sum = row === column ? kHorizonWeight : 0;
                values.forEach((y, i) => {
                    const azimuth = m === 0 ? 2 * Math.PI : Math.PI;
                    sum += ((1 - kHorizonWeight) * azimuth * weights[i] * y[shIndex(m + row, m)] * y[shIndex(m + column, m)]) / 2;
                });
                return sum;
            }),
        );
    const matrices = Array.from({ length: bandCount }, (_, m) => matrixOf(m));
    return (coefficients) => {
        const fitted = coefficients.slice();
        for (let m = 0; m < bandCount; ++m)
            solve(matrices[m], Array.from({ length: bandCount - m }, (_, k) => coefficients[shIndex(m + k, m)])).forEach(
                (value, k) => (fitted[shIndex(m + k, m)] = value),
            );
        return fitted;
    };
}

/** Solves a system whose matrix is positive definite, by elimination. */
function solve(rows: readonly number[][], right: number[]): number[] {
    const matrix = rows.map((row) => [...row]);
    const count = right.length;
    for (let pivot = 0; pivot < count; ++pivot)
        for (let row = pivot + 1; row < count; ++row) {
            const factor = matrix[row][pivot] / matrix[pivot][pivot];
            for (let column = pivot; column < count; ++column) matrix[row][column] -= factor * matrix[pivot][column];
            right[row] -= factor * right[pivot];
        }
    for (let row = count - 1; row >= 0; --row) {
        for (let column = row + 1; column < count; ++column) right[row] -= matrix[row][column] * right[column];
        right[row] /= matrix[row][row];
    }
    return right;
}
