import { type DataTexture, type Material, MeshBasicMaterial, type MeshStandardMaterial } from 'three';

import { type Layer, largestStored } from '../asset/layer.js';
import type { LayerLight } from './layer_light.js';

/** Name of the vertex attribute of radiance that was computed on the CPU. */
export const kRadianceAttribute = 'prtRadiance';

/** How the vertex shader finds radiance: GLSL with a function `vec3 prtRadianceOf()`, before the albedo, and its uniforms. */
export interface RadianceCode {
    code: string;
    uniforms: Record<string, { value: unknown }>;
    /** The code also writes `varying vec3 vPrtConstant`, which no base colour multiplies. */
    isGlossy?: boolean;
}

/** Radiance that was computed on the CPU. */
export const kRadianceOfAttribute: RadianceCode = {
    code: `attribute vec3 ${kRadianceAttribute};\nvec3 prtRadianceOf() { return ${kRadianceAttribute}; }`,
    uniforms: {},
};

/** Radiance that is summed from transfer in a texture. @param transfer  of the primitive (makeTransferTexture) */
export function sumRadiance(light: LayerLight, transfer: DataTexture): RadianceCode {
    return { code: codeOf(light), uniforms: { ...light.uniforms, prtTransfer: { value: transfer } } };
}

/**
 * A material that shows albedo(pixel) · B, with B found at vertices and interpolated.
 *
 * Everything else is as three.js's MeshBasicMaterial has it: vertex colours, textures, alpha, fog, tone curve.
 *
 * @param source  what the glTF's material became, whose base colour and alpha are taken
 */
export function makeRelightMaterial(source: Material, { code, uniforms, isGlossy }: RadianceCode): MeshBasicMaterial {
    const { color, map, alphaMap, alphaTest, transparent, opacity, side, vertexColors, depthWrite, blending, name } = source as MeshStandardMaterial;
    const material = new MeshBasicMaterial({ alphaTest, transparent, opacity, side, vertexColors, depthWrite, blending, name });
    if (color) material.color.copy(color);
    material.map = map ?? null;
    material.alphaMap = alphaMap ?? null;

    material.customProgramCacheKey = () => code;
    material.onBeforeCompile = (shader) => {
        Object.assign(shader.uniforms, uniforms);
        shader.vertexShader = `varying vec3 vPrtRadiance;\n${code}\n${shader.vertexShader}`.replace(
            '#include <begin_vertex>',
            '#include <begin_vertex>\n    vPrtRadiance = prtRadianceOf();',
        );
        // Bands may leave radiance below 0, which no screen shows.
        const [declaration, constant] = isGlossy ? ['varying vec3 vPrtConstant;\n', ' + vPrtConstant'] : ['', ''];
        shader.fragmentShader = `varying vec3 vPrtRadiance;\n${declaration}${shader.fragmentShader}`.replace(
            '#include <opaque_fragment>',
            `outgoingLight = max(diffuseColor.rgb * vPrtRadiance${constant}, 0.0);\n    #include <opaque_fragment>`,
        );
    };
    return material;
}

/** A function of the vertex that sums its radiance. */
function codeOf(light: LayerLight): string {
    const { layer, attributes } = light;
    const sampler = layer.storage.encoding === 'float32' ? 'sampler2D' : 'usampler2D';
    return `uniform highp ${sampler} prtTransfer;
vec4 prtNumbers(int slot) {
    int texel = gl_VertexID * ${attributes.length} + slot;
    int side = textureSize(prtTransfer, 0).x;
    return vec4(texelFetch(prtTransfer, ivec2(texel % side, texel / side), 0));
}
${layer.clusters ? clusterCode(layer) : sumCode(light)}`;
}

function sumCode({ terms }: LayerLight): string {
    const slots = [...new Set(terms.map(({ slot }) => slot))];
    const lines = slots.flatMap((slot) => [
        `    q = prtNumbers(${slot});`,
        ...terms.flatMap((term, i) => (term.slot === slot ? [`    sum[${term.channel}] += dot(prtWeights[${i}], q);`] : [])),
    ]);
    return `uniform vec3 prtConstant;
uniform vec4 prtWeights[${terms.length}];
vec3 prtRadianceOf() {
    vec3 sum = prtConstant;
    vec4 q;
${lines.join('\n')}
    return sum;
}`;
}

function clusterCode(layer: Layer): string {
    const { componentCount } = layer.clusters!;
    const lines: string[] = [];
    for (let p = 1; p <= componentCount; ++p) {
        if (p % 4 === 0) lines.push(`    q = prtNumbers(${p / 4});`);
        lines.push(`    sum += q[${p % 4}] * ${(1 / largestStored(layer.storage.encoding)).toExponential(17)} * prtProduct(first + ${p}).rgb;`);
    }
    return `uniform highp sampler2D prtProducts;
vec4 prtProduct(int texel) {
    int side = textureSize(prtProducts, 0).x;
    return texelFetch(prtProducts, ivec2(texel % side, texel / side), 0);
}
vec3 prtRadianceOf() {
    vec4 q = prtNumbers(0);
    int first = int(prtProduct(int(q.x + 0.5)).x + 0.5);
    vec3 sum = prtProduct(first).rgb;
${lines.join('\n')}
    return sum;
}`;
}
