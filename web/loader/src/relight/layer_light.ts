import { DataTexture, FloatType, RGBAFormat, Vector3 } from 'three';

import type { Layer } from '../asset/layer.js';
import type { Lighting } from '../sh/lighting.js';
import { bandCountOf, firstCoefficients, foldLight, type LayerRow, multiplyClusters } from './folded_light.js';

/** Four numbers of a vertex that add to one channel of its radiance. */
interface Term {
    /** Which of the attributes that the sum needs. */
    slot: number;
    channel: number;
}

/** The largest side of a texture that holds so many texels, at most 16384; every WebGL2 has 2048. */
export function textureSideFor(texelCount: number): number {
    let side = 2048;
    while (side * side < texelCount && side < 16384) side *= 2;
    return side;
}

/**
 * A light as the shader of one layer takes it, in uniforms that all primitives share. Of layers without clusters that is a weight for
 * each number of a vertex; of clusters a texture of R_kp behind one texel for each cluster, which says where its R_k0 stands.
 */
export class LayerLight {
    /** Which of the layer's attributes the sum needs: all of vectors, and of matrices those of one row. */
    readonly attributes: number[];
    readonly terms: Term[];
    readonly uniforms: Record<string, { value: unknown }>;
    private readonly constant = new Vector3();
    private readonly weights: Float32Array;
    private readonly products?: DataTexture;

    constructor(readonly layer: Layer, private readonly row: LayerRow) {
        if (layer.clusters) {
            this.attributes = [...Array(layer.attributeCount).keys()];
            this.terms = [];
            this.weights = new Float32Array(0);
            this.products = makeProducts(layer);
            this.uniforms = { prtProducts: { value: this.products } };
            return;
        }
        const ranges = this.attributeRanges();
        this.attributes = [...new Set(ranges.flat())].sort((a, b) => a - b);
        this.terms = ranges.flatMap((range, channel) => range.map((attribute) => ({ slot: this.attributes.indexOf(attribute), channel })));
        this.weights = new Float32Array(4 * this.terms.length);
        this.uniforms = { prtConstant: { value: this.constant }, prtWeights: { value: this.weights } };
    }

    /** @param lighting  in the frame of the objects */
    set(lighting: Lighting): void {
        const { layer } = this;
        if (this.products) {
            const texels = this.products.image.data as Float32Array;
            const first = layer.clusters!.componentCounts.length;
            multiplyClusters(layer, lighting, this.row).forEach((product, k) => (texels[4 * (first + Math.floor(k / 3)) + (k % 3)] = product));
            this.products.needsUpdate = true;
            return;
        }
        const { constant, weights } = foldLight(layer, lighting, this.row);
        const length = bandCountOf(layer) ** 2;
        const firsts = firstCoefficients(layer, this.row.row);
        this.constant.fromArray(constant);
        this.terms.forEach(({ slot, channel }, term) => {
            for (let k = 0; k < 4; ++k) {
                const j = 4 * this.attributes[slot] + k - firsts[channel];
                this.weights[4 * term + k] = j >= 0 && j < length ? weights[channel * length + j] : 0;
            }
        });
    }

    dispose(): void {
        this.products?.dispose();
    }

    /** The attributes that hold the row's coefficients, of red, green and blue. */
    private attributeRanges(): number[][] {
        const length = bandCountOf(this.layer) ** 2;
        return firstCoefficients(this.layer, this.row.row).map((first) => {
            const begin = Math.floor(first / 4);
            const count = Math.floor((first + length - 1) / 4) + 1 - begin;
            return Array.from({ length: count }, (_, k) => begin + k);
        });
    }
}

function makeProducts(layer: Layer): DataTexture {
    const { firstRows, componentCounts, componentCount, vectors } = layer.clusters!;
    // A cluster with few components is summed to the end of the longest, with weights 0: there must be texels.
    const texelCount = componentCounts.length + vectors.length / layer.coefficientCount + componentCount;
    const side = textureSideFor(texelCount);
    const height = Math.ceil(texelCount / side);
    const texels = new Float32Array(4 * side * height);
    firstRows.forEach((row, cluster) => (texels[4 * cluster] = componentCounts.length + row));
    return new DataTexture(texels, side, height, RGBAFormat, FloatType);
}
