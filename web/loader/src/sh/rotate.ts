import { type Mat3, type Vec3, gaussLegendre, transform, transpose } from '../math.js';
import type { Lighting } from './lighting.js';
import { evaluateSh } from './sh.js';

/** Directions and weights that integrate products of two functions of n bands exactly. */
interface SphereRule {
    directions: Vec3[];
    /** y_i of each direction times its weight, n² numbers each. */
    weighted: Float64Array[];
}

const rules: SphereRule[] = [];

/** n heights by Gauss and Legendre, and 2n − 1 azimuths. */
function sphereRuleOf(bandCount: number): SphereRule {
    const cached = rules[bandCount];
    if (cached) return cached;
    const rule: SphereRule = { directions: [], weighted: [] };
    const { nodes, weights } = gaussLegendre(bandCount);
    const azimuthCount = 2 * bandCount - 1;
    nodes.forEach((z, i) => {
        for (let k = 0; k < azimuthCount; ++k) {
            const phi = (2 * Math.PI * k) / azimuthCount;
            const sine = Math.sqrt(1 - z * z);
            const direction: Vec3 = [sine * Math.cos(phi), sine * Math.sin(phi), z];
            const weight = (weights[i] * 2 * Math.PI) / azimuthCount;
            rule.directions.push(direction);
            rule.weighted.push(evaluateSh(direction, bandCount).map((value) => value * weight));
        }
    });
    return (rules[bandCount] = rule);
}

/**
 * The light turned by a rotation: f(R⁻¹ω).
 *
 *   (M c)_i = ∫ f(R⁻¹ω) y_i(ω) dω
 *
 * The integrand is a polynomial, which few directions integrate exactly: no matrix M is needed.
 *
 * @param rotation  R, orthogonal; a reflection is one too
 */
export function rotateLighting({ bandCount, coefficients }: Lighting, rotation: Mat3): Lighting {
    const { directions, weighted } = sphereRuleOf(bandCount);
    const inverse = transpose(rotation);
    const rotated = new Float64Array(coefficients.length);
    const values = new Float64Array(bandCount ** 2);
    directions.forEach((direction, node) => {
        evaluateSh(transform(inverse, direction), bandCount, values);
        let [red, green, blue] = [0, 0, 0];
        for (let i = 0; i < values.length; ++i) {
            red += values[i] * coefficients[3 * i];
            green += values[i] * coefficients[3 * i + 1];
            blue += values[i] * coefficients[3 * i + 2];
        }
        const basis = weighted[node];
        for (let i = 0; i < basis.length; ++i) {
            rotated[3 * i] += red * basis[i];
            rotated[3 * i + 1] += green * basis[i];
            rotated[3 * i + 2] += blue * basis[i];
        }
    });
    return { bandCount, coefficients: rotated };
}
