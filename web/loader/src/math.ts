export type Vec3 = readonly [number, number, number];

/** A 3×3 matrix, row after row, that acts on column vectors (C9). */
export type Mat3 = readonly [number, number, number, number, number, number, number, number, number];

export function transform(m: Mat3, [x, y, z]: Vec3): Vec3 {
    return [m[0] * x + m[1] * y + m[2] * z, m[3] * x + m[4] * y + m[5] * z, m[6] * x + m[7] * y + m[8] * z];
}

export function transpose(m: Mat3): Mat3 {
    return [m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]];
}

/** Turns about the world's x axis, then y, then z, in degrees: active and right-handed, as `prt light --rotate` does. */
export function rotationXyz(xDegrees: number, yDegrees: number, zDegrees: number): Mat3 {
    const [a, b, c] = [xDegrees, yDegrees, zDegrees].map((degrees) => (degrees * Math.PI) / 180);
    const [sa, sb, sc] = [a, b, c].map(Math.sin);
    const [ca, cb, cc] = [a, b, c].map(Math.cos);
    return [
        cc * cb, cc * sb * sa - sc * ca, cc * sb * ca + sc * sa,
        sc * cb, sc * sb * sa + cc * ca, sc * sb * ca - cc * sa,
        -sb, cb * sa, cb * ca,
    ];
}

/**
 * R of a vertex's matrix, which takes a direction of the world into the vertex's frame: rows t, b, n [Duff17].
 *
 * @param normal  unit
 */
export function tangentFrame([x, y, z]: Vec3): Mat3 {
    const s = z > 0 || Object.is(z, 0) ? 1 : -1; // −0 counts as negative
    const a = -1 / (s + z);
    return [1 + s * x * x * a, s * x * y * a, -s * x, x * y * a, s + y * y * a, -y, x, y, z];
}

/** Nodes in (−1, 1) and weights that integrate polynomials of degree 2·count − 1 exactly. */
export function gaussLegendre(count: number): { nodes: Float64Array; weights: Float64Array } {
    const nodes = new Float64Array(count);
    const weights = new Float64Array(count);
    for (let i = 0; i < count; ++i) {
        let x = Math.cos((Math.PI * (i + 0.75)) / (count + 0.5)); // a guess, which Newton's steps mend
        let slope = 1;
        for (let step = 0; step < 100; ++step) {
            let before = 0;
            let value = 1; // P_0, and then P_k
            for (let k = 1; k <= count; ++k) [before, value] = [value, ((2 * k - 1) * x * value - (k - 1) * before) / k];
            slope = (count * (before - x * value)) / (1 - x * x);
            const change = value / slope;
            x -= change;
            if (Math.abs(change) < 1e-15) break;
        }
        nodes[i] = x;
        weights[i] = 2 / ((1 - x * x) * slope * slope);
    }
    return { nodes, weights };
}
