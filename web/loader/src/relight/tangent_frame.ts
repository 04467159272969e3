import type { Mat3, Vec3 } from '../math.js';

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
