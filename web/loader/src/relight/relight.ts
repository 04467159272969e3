import { type Layer, type StoredArray, isGlossy, largestStored } from '../asset/layer.js';
import { OpenPrtError } from '../error.js';
import type { Lighting } from '../sh/lighting.js';
import { type LayerRow, bandCountOf, diffuseRow, firstCoefficients, foldLight, multiplyClusters } from './folded_light.js';

/**
 * Relights the vertices of a primitive, as diffuse surfaces; of matrices by what they say of such.
 *
 *   B(x) = Σ_i T_i(x) L_i        outgoing radiance is albedo(x) · B(x) (C7)
 *
 * @param numbers   what the primitive stores of the layer
 * @param lighting  in the object's frame; bands beyond those of the layer go unused
 * @param radiance  B, three numbers a vertex, written
 */
export function relight(layer: Layer, numbers: StoredArray, lighting: Lighting, radiance?: Float32Array): Float32Array {
    const row = diffuseRow(layer);
    if (!row) throw new OpenPrtError('unsupported', 'matrices of one incident band say nothing of diffuse surfaces');
    const written = radiance ?? new Float32Array((3 * numbers.length) / (4 * layer.attributeCount));
    relightRow(layer, numbers, lighting, row, written, 3, 0);
    return written;
}

/**
 * The light as it arrives at the vertices of a primitive, of a layer of matrices: l_i = Σ_j M_ij L_j in each vertex's own frame.
 *
 * @returns  l_i of channel c of a vertex at 3 (vertex · n_in² + i) + c
 */
export function receiveLight(layer: Layer, numbers: StoredArray, lighting: Lighting): Float32Array {
    if (!isGlossy(layer.transport)) throw new OpenPrtError('invalidOption', `${layer.transport} transport has vectors, not matrices`);
    const rowCount = layer.incidentBandCount ** 2;
    const incident = new Float32Array((3 * rowCount * numbers.length) / (4 * layer.attributeCount));
    for (let row = 0; row < rowCount; ++row)
        relightRow(layer, numbers, lighting, { row, factor: 1 }, incident, 3 * rowCount, 3 * row);
    return incident;
}

function relightRow(
    layer: Layer, numbers: StoredArray, lighting: Lighting, row: LayerRow, written: Float32Array, stride: number, offset: number,
): void {
    if (layer.clusters) sumClusters(layer, numbers, multiplyClusters(layer, lighting, row), written, stride, offset);
    else sumNumbers(layer, numbers, lighting, row, written, stride, offset);
}

function sumNumbers(
    layer: Layer, numbers: StoredArray, lighting: Lighting, row: LayerRow, written: Float32Array, stride: number, offset: number,
): void {
    const { constant, weights } = foldLight(layer, lighting, row);
    const [red, green, blue] = firstCoefficients(layer, row.row);
    const length = bandCountOf(layer) ** 2;
    const width = 4 * layer.attributeCount;
    for (let begin = 0, to = offset; begin < numbers.length; begin += width, to += stride) {
        let [r, g, b] = constant;
        for (let j = 0; j < length; ++j) {
            r += weights[j] * numbers[begin + red + j];
            g += weights[length + j] * numbers[begin + green + j];
            b += weights[2 * length + j] * numbers[begin + blue + j];
        }
        written[to] = r;
        written[to + 1] = g;
        written[to + 2] = b;
    }
}

function sumClusters(layer: Layer, numbers: StoredArray, products: Float32Array, written: Float32Array, stride: number, offset: number): void {
    const { componentCounts, firstRows } = layer.clusters!;
    const width = 4 * layer.attributeCount;
    const unit = 1 / largestStored(layer.storage.encoding);
    for (let begin = 0, to = offset; begin < numbers.length; begin += width, to += stride) {
        const cluster = numbers[begin];
        let product = 3 * firstRows[cluster];
        let [r, g, b] = [products[product], products[product + 1], products[product + 2]];
        for (let p = 1; p <= componentCounts[cluster]; ++p) {
            const weight = unit * numbers[begin + p];
            product += 3;
            r += weight * products[product];
            g += weight * products[product + 1];
            b += weight * products[product + 2];
        }
        written[to] = r;
        written[to + 1] = g;
        written[to + 2] = b;
    }
}
