import { DataTexture, FloatType, type Material, type MeshStandardMaterial, RGBAFormat, type Texture } from 'three';

import { kViewCount, makeLobeTable } from './gltf_lobes.js';
import type { RadianceCode } from './relight_material.js';

/** How metallic and rough a surface is. */
export interface Surface {
    metallic: number;
    roughness: number;
    /** Whose blue multiplies `metallic`, and whose green `roughness`, looked up at the vertices. */
    texture?: Texture;
}

// Levels of roughness, evenly from 0 to 1, between which lobes are linear.
const kLevelCount = 16;

export function surfaceOf(material: Material): Surface {
    const { metalness = 0, roughness = 1, metalnessMap } = material as Partial<MeshStandardMaterial>;
    return { metallic: metalness, roughness, ...(metalnessMap ? { texture: metalnessMap } : {}) };
}

/** K, B and D (makeLobeTable) of a surface's roughness, or of all levels, as a texture: a row a view. */
export function makeLobeTexture({ roughness, texture }: Surface, bandCount: number): DataTexture {
    const levels = texture ? Array.from({ length: kLevelCount }, (_, level) => level / (kLevelCount - 1)) : [roughness];
    const tables = levels.map((level) => makeLobeTable(level, bandCount));
    const texels = new Float32Array(tables.length * tables[0].length);
    tables.forEach((table, level) => texels.set(table, level * table.length));
    const lobes = new DataTexture(texels, (bandCount * (bandCount + 1)) / 2, kViewCount * levels.length, RGBAFormat, FloatType);
    lobes.needsUpdate = true;
    return lobes;
}

export function surfaceUniforms({ metallic, roughness, texture }: Surface): RadianceCode['uniforms'] {
    const uniforms = { prtMetallic: { value: metallic } };
    if (!texture) return uniforms;
    texture.updateMatrix();
    const { matrix } = texture;
    return { ...uniforms, prtRoughness: { value: roughness }, prtSurface: { value: texture }, prtSurfaceFromUv: { value: matrix } };
}

/** GLSL: `prtFindSurface()` sets `prtMetallicHere`, and after it `prtLobe(row, element)` is of the roughness here. */
export function surfaceCode({ texture }: Surface): string {
    if (!texture)
        return `uniform highp sampler2D prtLobes;
uniform float prtMetallic;
float prtMetallicHere;
void prtFindSurface() { prtMetallicHere = prtMetallic; }
vec3 prtLobe(int row, int element) { return texelFetch(prtLobes, ivec2(element, row), 0).rgb; }
`;
    // Every shader of three.js has the first coordinates, and others where their numbers are defined.
    const [uv, number] = texture.channel === 0 ? ['uv', ''] : [`uv${texture.channel}`, `UV${texture.channel}`];
    const declaration = number && `#ifndef USE_${number}\nattribute vec2 ${uv};\n#endif\n`;
    return `${declaration}uniform highp sampler2D prtLobes;
uniform highp sampler2D prtSurface;
uniform mat3 prtSurfaceFromUv;
uniform float prtMetallic;
uniform float prtRoughness;
float prtMetallicHere;
float prtLevelShare;
int prtLevel;
void prtFindSurface() {
    vec4 texel = textureLod(prtSurface, (prtSurfaceFromUv * vec3(${uv}, 1.0)).xy, 0.0);
    prtMetallicHere = clamp(prtMetallic * texel.b, 0.0, 1.0);
    float place = clamp(prtRoughness * texel.g, 0.0, 1.0) * ${(kLevelCount - 1).toFixed(1)};
    prtLevel = min(int(place), ${kLevelCount - 2});
    prtLevelShare = place - float(prtLevel);
}
vec3 prtLobe(int row, int element) {
    ivec2 texel = ivec2(element, ${kViewCount} * prtLevel + row);
    return mix(texelFetch(prtLobes, texel, 0), texelFetch(prtLobes, texel + ivec2(0, ${kViewCount}), 0), prtLevelShare).rgb;
}
`;
}
