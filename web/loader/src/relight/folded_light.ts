import { type Layer, isGlossy, largestStored } from '../asset/layer.js';
import { type Lighting, withBands } from '../sh/lighting.js';

/** √(4/3π): a diffuse surface reflects so much of row 2 of its matrix (docs/format.md). */
const kDiffuseOfMatrix = 0.65147001587055990;

/** One row of a layer: of vectors the only one, of matrices what makes l_i of one i. */
export interface LayerRow {
    /** Of `vectors` 0; else i. */
    row: number;
    /** What the sum is multiplied by. */
    factor: number;
}

/** The row that a diffuse surface reflects; none where a matrix is of one band. */
export function diffuseRow(layer: Layer): LayerRow | undefined {
    if (!isGlossy(layer.transport)) return { row: 0, factor: 1 };
    return layer.incidentBandCount > 1 ? { row: 2, factor: kDiffuseOfMatrix } : undefined;
}

/** n of the light that a layer takes. */
export function bandCountOf(layer: Layer): number {
    return Math.round(Math.sqrt(layer.coefficientCount / (layer.channelCount * Math.max(1, layer.incidentBandCount ** 2))));
}

/** The first of the n² coefficients of a row, of red, green and blue. */
export function firstCoefficients(layer: Layer, row: number): [number, number, number] {
    const rowCount = Math.max(1, layer.incidentBandCount ** 2);
    const length = bandCountOf(layer) ** 2;
    const first = (channel: number): number => ((layer.channelCount === 1 ? 0 : channel) * rowCount + row) * length;
    return [first(0), first(1), first(2)];
}

/** A light made ready for stored numbers: Σ_j T_j L_j = constant + Σ_j weight_j q_j. */
export interface FoldedLight {
    constant: Float64Array;
    /** Of channel c and number firstCoefficients[c] + j at c · n² + j. */
    weights: Float64Array;
}

/** Takes scale and bias of a layer without clusters into the light. */
export function foldLight(layer: Layer, lighting: Lighting, { row, factor }: LayerRow): FoldedLight {
    const { storage } = layer;
    const bandCount = bandCountOf(layer);
    const { coefficients } = withBands(lighting, bandCount);
    const length = bandCount ** 2;
    const folded = { constant: new Float64Array(3), weights: new Float64Array(3 * length) };
    firstCoefficients(layer, row).forEach((first, channel) => {
        for (let j = 0; j < length; ++j) {
            const light = factor * coefficients[3 * j + channel];
            const isFloat = storage.encoding === 'float32';
            folded.weights[channel * length + j] = isFloat ? light : (light * storage.scale[first + j]) / largestStored(storage.encoding);
            if (!isFloat) folded.constant[channel] += light * storage.bias[first + j];
        }
    });
    return folded;
}

/** Of a layer with clusters: R_kp = Σ_i b_kp,i L_i of each row of its vectors, three numbers a row. */
export function multiplyClusters(layer: Layer, lighting: Lighting, { row, factor }: LayerRow): Float32Array {
    const { vectors } = layer.clusters!;
    const bandCount = bandCountOf(layer);
    const { coefficients } = withBands(lighting, bandCount);
    const firsts = firstCoefficients(layer, row);
    const products = new Float32Array((vectors.length / layer.coefficientCount) * 3);
    for (let k = 0; k < products.length; ++k) {
        const channel = k % 3;
        const begin = Math.floor(k / 3) * layer.coefficientCount + firsts[channel];
        let sum = 0;
        for (let j = 0; j < bandCount ** 2; ++j) sum += vectors[begin + j] * coefficients[3 * j + channel];
        products[k] = factor * sum;
    }
    return products;
}
