import type { Vec3 } from '../math.js';
import { type Lighting, darkness } from './lighting.js';
import { evaluateSh, shIndex } from './sh.js';

/** The same radiance from everywhere: L_00 = √(4π) L. */
export function uniformLighting(radiance: Vec3, bandCount: number): Lighting {
    const lighting = darkness(bandCount);
    lighting.coefficients.set(radiance.map((value) => value * Math.sqrt(4 * Math.PI)));
    return lighting;
}

/**
 * A disc of constant radiance [Sloan08, appendix A3]: L_lm = 2π ∫ P_l(t) dt · y_lm(direction), t from cos α to 1.
 *
 * @param direction         unit, towards the disc's centre
 * @param halfAngleRadians  α, in (0, π]
 */
export function discLighting(direction: Vec3, halfAngleRadians: number, radiance: Vec3, bandCount: number): Lighting {
    const integrals = integrateLegendre(Math.cos(halfAngleRadians), bandCount);
    integrals[0] = 2 * Math.sin(halfAngleRadians / 2) ** 2; // 1 − cos α, of small angles too
    return zonalLighting(integrals.map((integral) => 2 * Math.PI * integral), direction, radiance);
}

/** A disc that gives unit irradiance to a surface facing it, whatever its size; with half angle 0 light from one direction. */
export function sunLighting(direction: Vec3, halfAngleRadians: number, bandCount: number): Lighting {
    if (halfAngleRadians === 0) return zonalLighting(new Float64Array(bandCount).fill(1), direction, [1, 1, 1]);
    const sine = Math.sin(Math.min(halfAngleRadians, Math.PI / 2)); // it sees no more than its own hemisphere
    const radiance = 1 / (Math.PI * sine * sine);
    return discLighting(direction, halfAngleRadians, [radiance, radiance, radiance], bandCount);
}

/** Where `sun:azimuth,elevation` of prt stands: azimuth from +x towards +z, elevation above the horizon. */
export function sunDirection(azimuthDegrees: number, elevationDegrees: number): Vec3 {
    const [azimuth, elevation] = [azimuthDegrees, elevationDegrees].map((degrees) => (degrees * Math.PI) / 180);
    return [Math.cos(elevation) * Math.cos(azimuth), Math.sin(elevation), Math.cos(elevation) * Math.sin(azimuth)];
}

/** Σ over m of factor_l y_lm(direction), in a colour. */
function zonalLighting(factors: Float64Array, direction: Vec3, color: Vec3): Lighting {
    const lighting = darkness(factors.length);
    const values = evaluateSh(direction, factors.length);
    for (let l = 0; l < factors.length; ++l)
        for (let i = shIndex(l, -l); i <= shIndex(l, l); ++i)
            for (let channel = 0; channel < 3; ++channel) lighting.coefficients[3 * i + channel] = factors[l] * values[i] * color[channel];
    return lighting;
}

/** ∫ P_l(t) dt from c to 1 = (P_{l−1}(c) − P_{l+1}(c)) / (2l + 1), of each band but the first. */
function integrateLegendre(c: number, bandCount: number): Float64Array {
    const legendre = [1, c];
    for (let l = 1; l <= bandCount; ++l) legendre.push(((2 * l + 1) * c * legendre[l] - l * legendre[l - 1]) / (l + 1));
    return Float64Array.from({ length: bandCount }, (_, l) => (l === 0 ? 1 - c : (legendre[l - 1] - legendre[l + 1]) / (2 * l + 1)));
}
