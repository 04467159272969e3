// Bibliography
//   [Ramamoorthi01]  An efficient representation for irradiance environment maps
import { type Lighting, applyWindow, clampedCosineFactors, reconstruct, withBands } from 'openprt-three';

import { directionOf } from './light_picture.js';

const kBrightest = 0.8;
const kBandCount = 3;
const kHeight = 64;

/** Irradiance of degree l is radiance times this, A_l [Ramamoorthi01]; over π, what white surfaces reflect. */
const kReflected = clampedCosineFactors(kBandCount).map((factor) => factor / Math.PI);

/**
 * The stops under which the brightest side of a white diffuse sphere is shown as 0.8, from the light's first three bands, as
 * `prt export` exposes. A turn of the light changes it by less than can be seen; the page asks before it turns.
 */
export function chooseExposure(lighting: Lighting): number {
    const reflected = applyWindow(withBands(lighting, kBandCount), kReflected);
    let brightest = 0;
    for (let row = 0; row < kHeight; ++row)
        for (let column = 0; column < 2 * kHeight; ++column) {
            const [red, green, blue] = reconstruct(reflected, directionOf(column, row, kHeight));
            brightest = Math.max(brightest, 0.2126 * red + 0.7152 * green + 0.0722 * blue);
        }
    return brightest > 0 ? Math.log2(kBrightest / brightest) : 0;
}
