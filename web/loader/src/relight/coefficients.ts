import { type Layer, type StoredArray, largestStored } from '../asset/layer.js';

/**
 * The coefficients of a primitive's vertices, K a vertex, whatever form they are stored in.
 *
 * @param numbers  what is stored of the layer, as an AssetPrimitive has it
 */
export function coefficientsOf(layer: Layer, numbers: StoredArray): Float32Array {
    const { coefficientCount: rowLength, clusters } = layer;
    const width = 4 * layer.attributeCount;
    const vertexCount = numbers.length / width;
    const values = new Float32Array(vertexCount * rowLength);
    const largest = largestStored(layer.storage.encoding);
    for (let vertex = 0; vertex < vertexCount; ++vertex) {
        const row = vertex * width;
        for (let c = 0; c < rowLength; ++c) {
            let value: number;
            if (clusters) {
                const first = clusters.firstRows[numbers[row]];
                value = clusters.vectors[first * rowLength + c];
                for (let p = 1; p <= clusters.componentCounts[numbers[row]]; ++p)
                    value += (numbers[row + p] / largest) * clusters.vectors[(first + p) * rowLength + c];
            } else {
                value = decode(layer, numbers[row + c], c, largest);
            }
            values[vertex * rowLength + c] = value;
        }
    }
    return values;
}

function decode({ storage }: Layer, stored: number, c: number, largest: number): number {
    return storage.encoding === 'float32' ? stored : storage.bias[c] + (storage.scale[c] * stored) / largest;
}
