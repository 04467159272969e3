import { OpenPrtError } from '../error.js';
import type { Vec3 } from '../math.js';
import { evaluateSh } from './sh.js';

/** The most bands of a file of coefficients. */
const kMaxLightingBandCount = 64;

/** Distant light in the SH basis: L_i = ∫ L(ω) y_i(ω) dω for each of red, green, blue (C2, C3, C5). Not to be changed. */
export interface Lighting {
    readonly bandCount: number;
    /** Coefficient i of channel c at 3i + c; 3n² numbers. */
    readonly coefficients: Float64Array;
}

export function darkness(bandCount: number): Lighting {
    return { bandCount, coefficients: new Float64Array(3 * bandCount ** 2) };
}

/** Sum of lights; it has the bands of the one that has most. */
export function addLighting(...lights: readonly Lighting[]): Lighting {
    const sum = darkness(Math.max(1, ...lights.map((light) => light.bandCount)));
    for (const { coefficients } of lights) coefficients.forEach((coefficient, i) => (sum.coefficients[i] += coefficient));
    return sum;
}

export function scaleLighting(lighting: Lighting, [red, green, blue]: Vec3): Lighting {
    const factors = [red, green, blue];
    return { bandCount: lighting.bandCount, coefficients: lighting.coefficients.map((value, i) => value * factors[i % 3]) };
}

/** The first n bands; those that the light lacks are 0. */
export function withBands(lighting: Lighting, bandCount: number): Lighting {
    const result = darkness(bandCount);
    result.coefficients.set(lighting.coefficients.subarray(0, result.coefficients.length));
    return result;
}

/** Each band times its factor. */
export function applyWindow(lighting: Lighting, factors: ArrayLike<number>): Lighting {
    const coefficients = lighting.coefficients.map((value, k) => value * factors[Math.floor(Math.sqrt(Math.floor(k / 3)))]);
    return { bandCount: lighting.bandCount, coefficients };
}

/** The radiance that the coefficients stand for, in one direction. */
export function reconstruct({ bandCount, coefficients }: Lighting, direction: Vec3): Vec3 {
    const sum: [number, number, number] = [0, 0, 0];
    evaluateSh(direction, bandCount).forEach((value, i) => {
        for (let channel = 0; channel < 3; ++channel) sum[channel] += value * coefficients[3 * i + channel];
    });
    return sum;
}

/** Reads what `prt light --format json` writes: {"bands": n, "convention": "cs", "coefficients": [[r, g, b], …]}. */
export function parseLighting(json: unknown): Lighting {
    const refuse = (why: string): never => {
        throw new OpenPrtError('malformed', `the coefficients of a light ${why}`);
    };
    const { bands, convention, coefficients } = (json ?? {}) as Record<string, unknown>;
    if (convention !== 'cs') refuse(`are in the convention "${String(convention)}", and this reader knows "cs"`);
    if (typeof bands !== 'number' || !Number.isInteger(bands) || bands < 1 || bands > kMaxLightingBandCount)
        return refuse(`must be of 1 to ${kMaxLightingBandCount} bands`);
    if (!Array.isArray(coefficients) || coefficients.length !== bands ** 2) return refuse(`must be ${bands ** 2} for ${bands} bands`);
    const isColor = (value: unknown): boolean => Array.isArray(value) && value.length === 3 && value.every(Number.isFinite);
    if (!coefficients.every(isColor)) refuse('must be three numbers each');
    return { bandCount: bands, coefficients: Float64Array.from(coefficients.flat() as number[]) };
}

/**
 * The first three bands as three.js's SphericalHarmonics3 and LightProbe have them, without the phase: nine [r, g, b], to be put in
 * `sh.coefficients` by `fromArray` of each.
 */
export function toThreeProbe(lighting: Lighting): Vec3[] {
    const { coefficients } = withBands(lighting, 3);
    return [1, -1, 1, -1, 1, -1, 1, -1, 1].map((sign, i) => [
        sign * coefficients[3 * i], sign * coefficients[3 * i + 1], sign * coefficients[3 * i + 2],
    ]);
}
