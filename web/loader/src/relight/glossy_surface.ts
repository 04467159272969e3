import { DataTexture, FloatType, RGBAFormat } from 'three';

import type { Layer, StoredArray } from '../asset/layer.js';
import type { Lighting } from '../sh/lighting.js';
import { shIndex } from '../sh/sh.js';
import { kMostViewPlace, kViewCount } from './gltf_lobes.js';
import { textureSideFor } from './layer_light.js';
import { receiveLight } from './relight.js';
import type { RadianceCode } from './relight_material.js';
import { type Surface, surfaceCode, surfaceUniforms } from './surface.js';

/**
 * A primitive as it shines: the light that arrives at its vertices, summed on the CPU when the light changes, and what the vertex shader
 * makes of it for the eye.
 */
export class GlossySurface {
    readonly radiance: RadianceCode;
    private readonly incident: DataTexture;

    constructor(private readonly layer: Layer, private readonly numbers: StoredArray, lobes: DataTexture, surface: Surface) {
        const texelCount = (numbers.length / (4 * layer.attributeCount)) * layer.incidentBandCount ** 2;
        const side = textureSideFor(texelCount);
        const height = Math.ceil(texelCount / side);
        this.incident = new DataTexture(new Float32Array(4 * side * height), side, height, RGBAFormat, FloatType);
        this.radiance = {
            code: surfaceCode(surface) + codeOf(layer.incidentBandCount),
            uniforms: { prtIncident: { value: this.incident }, prtLobes: { value: lobes }, ...surfaceUniforms(surface) },
            isGlossy: true,
        };
    }

    /** @param lighting  in the frame of the object */
    set(lighting: Lighting): void {
        const texels = this.incident.image.data as Float32Array;
        const incident = receiveLight(this.layer, this.numbers, lighting);
        for (let from = 0, to = 0; from < incident.length; from += 3, to += 4) {
            texels[to] = incident[from];
            texels[to + 1] = incident[from + 1];
            texels[to + 2] = incident[from + 2];
        }
        this.incident.needsUpdate = true;
    }

    dispose(): void {
        this.incident.dispose();
    }
}

/** Σ_i f_i(ω_o) l_i, as reflect() sums it. */
function codeOf(bandCount: number): string {
    const lines: string[] = [];
    for (let m = 0; m < bandCount; ++m) {
        for (let l = m; l < bandCount; ++l) {
            const turned = m === 0 ? `prtIncidentOf(${shIndex(l, 0)})` : `(turn.x * prtIncidentOf(${shIndex(l, m)}) + turn.y * prtIncidentOf(${shIndex(l, -m)}))`;
            lines.push(`    prtAdd(${turned}, mix(prtLobe(row, ${(l * (l + 1)) / 2 + m}), prtLobe(row + 1, ${(l * (l + 1)) / 2 + m}), share));`);
        }
        lines.push('    turn = vec2(turn.x * azimuth.x - turn.y * azimuth.y, turn.x * azimuth.y + turn.y * azimuth.x);');
    }
    return `uniform highp sampler2D prtIncident;
varying vec3 vPrtConstant;
vec3 prtPerBaseColor;
vec3 prtIncidentOf(int i) {
    int texel = gl_VertexID * ${bandCount ** 2} + i;
    int side = textureSize(prtIncident, 0).x;
    return texelFetch(prtIncident, ivec2(texel % side, texel / side), 0).rgb;
}
void prtAdd(vec3 radiance, vec3 lobes) {
    float rest = lobes.g - lobes.r;
    prtPerBaseColor += radiance * ((1.0 - prtMetallicHere) * 0.96 * lobes.b + prtMetallicHere * rest);
    vPrtConstant += radiance * (lobes.r + 0.04 * (1.0 - prtMetallicHere) * rest);
}
vec3 prtRadianceOf() {
    prtFindSurface();
    // The view in the frame of the vertex.
    vec3 n = normalize(normal);
    vec3 view = isOrthographic
        ? normalize((vec4(viewMatrix[0][2], viewMatrix[1][2], viewMatrix[2][2], 0.0) * modelMatrix).xyz)
        : normalize((inverse(modelMatrix) * vec4(cameraPosition, 1.0)).xyz - position);
    float s = floatBitsToInt(n.z) < 0 ? -1.0 : 1.0;
    float a = -1.0 / (s + n.z);
    vec3 t = vec3(1.0 + s * n.x * n.x * a, s * n.x * n.y * a, -s * n.x);
    vec3 b = vec3(n.x * n.y * a, s + n.y * n.y * a, -n.y);
    vec3 wo = vec3(dot(t, view), dot(b, view), dot(n, view));
    float place = min(sqrt(max(1.0 - wo.z, 0.0)) / ${kMostViewPlace}, 1.0) * ${(kViewCount - 1).toFixed(1)};
    int row = min(int(place), ${kViewCount - 2});
    float share = place - float(row);
    float radius = length(wo.xy);
    vec2 azimuth = radius > 0.0 ? wo.xy / radius : vec2(1.0, 0.0);
    vec2 turn = vec2(1.0, 0.0);
    prtPerBaseColor = vec3(0.0);
    vPrtConstant = vec3(0.0);
${lines.join('\n')}
    return prtPerBaseColor;
}`;
}
