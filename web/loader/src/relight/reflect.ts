import { type Vec3, tangentFrame, transform } from '../math.js';
import { shIndex } from '../sh/sh.js';
import { kMostViewPlace, kViewCount } from './gltf_lobes.js';

/** What leaves a surface towards the eye: baseColor · perBaseColor + constant. */
export interface ExitRadiance {
    perBaseColor: [number, number, number];
    constant: [number, number, number];
}

/**
 * What a vertex shows of the light that arrives: Σ_i f_i(ω_o) l_i, as the shader sums it.
 *
 * @param incident  l_i of channel c at 3i + c, from `first` on (receiveLight)
 * @param view      ω_o, unit, in the frame of the object
 * @param lobes     of the material's roughness (makeLobeTable)
 */
export function reflect(
    incident: Float32Array, first: number, bandCount: number, normal: Vec3, view: Vec3, lobes: Float32Array, metallic: number,
): ExitRadiance {
    const [x, y, z] = transform(tangentFrame(normal), view);
    const place = Math.min(Math.sqrt(Math.max(1 - z, 0)) / kMostViewPlace, 1) * (kViewCount - 1);
    const row = Math.min(Math.floor(place), kViewCount - 2);
    const azimuth = Math.atan2(y, x);
    const uprightCount = (bandCount * (bandCount + 1)) / 2;
    const result: ExitRadiance = { perBaseColor: [0, 0, 0], constant: [0, 0, 0] };
    for (let l = 0; l < bandCount; ++l)
        for (let m = 0; m <= l; ++m) {
            const at = 4 * (row * uprightCount + (l * (l + 1)) / 2 + m);
            const [dark, bright, diffuse] = [0, 1, 2].map((k) => lobes[at + k] + (place - row) * (lobes[at + 4 * uprightCount + k] - lobes[at + k]));
            for (let channel = 0; channel < 3; ++channel) {
                const radianceOf = (order: number): number => incident[first + 3 * shIndex(l, order) + channel];
                const turned = m === 0 ? radianceOf(0) : Math.cos(m * azimuth) * radianceOf(m) + Math.sin(m * azimuth) * radianceOf(-m);
                result.perBaseColor[channel] += turned * ((1 - metallic) * 0.96 * diffuse + metallic * (bright - dark));
                result.constant[channel] += turned * (dark + 0.04 * (1 - metallic) * (bright - dark));
            }
        }
    return result;
}
