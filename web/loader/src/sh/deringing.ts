// Bibliography
//   [Sloan17]  Deringing spherical harmonics
import { type Vec3, gaussLegendre, tangentFrame, transform, transpose } from '../math.js';
import type { Lighting } from './lighting.js';
import { evaluateSh, shIndex } from './sh.js';

/** What of a light must not be negative in any direction: itself, or what a surface of any normal receives of it. */
export type NonNegative = 'radiance' | 'irradiance';

const kRoundingOfMean = 1e-10;
const kRowsPerBand = 6;
const kMostSteps = 60;
const kFinestStepRadians = 1e-7;

/**
 * The least Laplacian smoothing, 1 / (1 + λ l²(l+1)²), under which no channel is negative anywhere, the same for the three channels
 * [Sloan17]: the first such λ, going up from 0. A channel whose mean is not positive cannot be helped and is left out.
 *
 * At the lowest point found λ rises until the function is not negative there, until no point is negative.
 *
 * @returns  one factor a band, the first 1
 */
export function deringingFactors({ bandCount, coefficients }: Lighting, nonNegative: NonNegative = 'radiance'): Float64Array {
    const kernel = nonNegative === 'irradiance' ? clampedCosineFactors(bandCount) : new Float64Array(bandCount).fill(1);
    const grid = makeGrid(bandCount);
    const channels = [0, 1, 2]
        .filter((channel) => coefficients[channel] > 0)
        .map((channel) => {
            const own = Float64Array.from({ length: bandCount ** 2 }, (_, i) => coefficients[3 * i + channel] * kernel[Math.floor(Math.sqrt(i))]);
            return { own, rounding: kRoundingOfMean * own[0], onGrid: grid.map((point) => sumBands(own, point.direction, bandCount)) };
        });
    let lambda = 0;
    for (let step = 0; step < kMostSteps; ++step) {
        const before = lambda;
        for (const { own, rounding, onGrid } of channels) {
            const factors = laplacianFactors(lambda, bandCount);
            for (const low of lowMinima(onGrid.map((bands) => dot(bands, factors)), grid)) {
                const bottom = descend(grid[low].direction, Math.PI / (kRowsPerBand * bandCount), (direction) =>
                    dot(sumBands(own, direction, bandCount), factors),
                );
                const bands = sumBands(own, bottom, bandCount);
                bands[0] += rounding;
                lambda = leastLambda(bands, lambda);
            }
        }
        if (lambda === before) break;
    }
    return laplacianFactors(lambda, bandCount);
}

/** 1 / (1 + λ l²(l+1)²). */
export function laplacianFactors(lambda: number, bandCount: number): Float64Array {
    return Float64Array.from({ length: bandCount }, (_, l) => 1 / (1 + lambda * (l * (l + 1)) ** 2));
}

/** What irradiance multiplies degree l of radiance by, A_l = 2π ∫ t P_l(t) dt over [0, 1] [Ramamoorthi01]. */
export function clampedCosineFactors(bandCount: number): Float64Array {
    const { nodes, weights } = gaussLegendre(bandCount + 1);
    const factors = new Float64Array(bandCount);
    nodes.forEach((node, i) => {
        const t = (node + 1) / 2;
        const values = evaluateSh([Math.sqrt(1 - t * t), 0, t], bandCount);
        for (let l = 0; l < bandCount; ++l)
            factors[l] += Math.PI * weights[i] * t * values[shIndex(l, 0)] * Math.sqrt((4 * Math.PI) / (2 * l + 1));
    });
    return factors;
}

function dot(a: Float64Array, b: Float64Array): number {
    let sum = 0;
    for (let i = 0; i < a.length; ++i) sum += a[i] * b[i];
    return sum;
}

/** What each band adds in a direction. */
function sumBands(coefficients: Float64Array, direction: Vec3, bandCount: number): Float64Array {
    const values = evaluateSh(direction, bandCount);
    const bands = new Float64Array(bandCount);
    for (let l = 0; l < bandCount; ++l) for (let i = shIndex(l, -l); i <= shIndex(l, l); ++i) bands[l] += coefficients[i] * values[i];
    return bands;
}

interface GridPoint {
    direction: Vec3;
    neighbours: number[];
}

/** Points so dense that every minimum of n bands has one beside it. */
function makeGrid(bandCount: number): GridPoint[] {
    const rowCount = kRowsPerBand * bandCount;
    const columnCount = 2 * rowCount;
    return Array.from({ length: rowCount * columnCount }, (_, index) => {
        const row = Math.floor(index / columnCount);
        const column = index % columnCount;
        const theta = (Math.PI * (row + 0.5)) / rowCount;
        const phi = (2 * Math.PI * column) / columnCount;
        const east = row * columnCount + ((column + 1) % columnCount);
        const west = row * columnCount + ((column + columnCount - 1) % columnCount);
        const neighbours = [east, west, index - columnCount, index + columnCount];
        return {
            direction: [Math.sin(theta) * Math.cos(phi), Math.sin(theta) * Math.sin(phi), Math.cos(theta)],
            neighbours: neighbours.filter((neighbour) => neighbour >= 0 && neighbour < rowCount * columnCount),
        };
    });
}

/** Points no higher than their neighbours, and so low that the function may be negative beside them. */
function lowMinima(values: readonly number[], grid: readonly GridPoint[]): number[] {
    // n bands rise by at most (π/6)²/4 of their largest value within half a grid's cell of a minimum (Bernstein).
    const largest = values.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
    const ceiling = 0.075 * largest;
    return [...grid.keys()].filter((i) => values[i] <= ceiling && grid[i].neighbours.every((other) => values[i] <= values[other]));
}

/** The bottom of the basin of a direction, by steps across it that become smaller. */
function descend(from: Vec3, stepRadians: number, valueAt: (direction: Vec3) => number): Vec3 {
    let best = from;
    let lowest = valueAt(from);
    for (let step = stepRadians; step > kFinestStepRadians; ) {
        const lower = around(best, step).find((direction) => valueAt(direction) < lowest);
        if (lower) {
            best = lower;
            lowest = valueAt(lower);
        } else {
            step /= 2;
        }
    }
    return best;
}

/** Eight directions about one, at a small angle. */
function around(direction: Vec3, angleRadians: number): Vec3[] {
    const worldFromLocal = transpose(tangentFrame(direction));
    return [0, 1, 2, 3, 4, 5, 6, 7].map((k) => {
        const sine = Math.sin(angleRadians);
        const azimuth = (k * Math.PI) / 4;
        const [x, y, z] = transform(worldFromLocal, [sine * Math.cos(azimuth), sine * Math.sin(azimuth), Math.cos(angleRadians)]);
        const length = Math.hypot(x, y, z);
        return [x / length, y / length, z / length];
    });
}

/** The first λ from one on under which Σ_l b_l / (1 + λ l²(l+1)²) is not negative; b_0 is positive. */
function leastLambda(bands: Float64Array, from: number): number {
    const valueAt = (lambda: number): number => dot(bands, laplacianFactors(lambda, bands.length));
    const start = valueAt(from);
    if (start >= 0) return from;
    let steepest = 0; // the sum is nowhere steeper above
    bands.forEach((band, l) => (steepest += (Math.abs(band) * (l * (l + 1)) ** 2) / (1 + from * (l * (l + 1)) ** 2) ** 2));
    let low = from;
    let high = from - start / steepest;
    while (valueAt(high) < 0) {
        low = high;
        high *= 1.125;
    }
    for (let step = 0; step < 60; ++step) {
        const middle = (low + high) / 2;
        if (valueAt(middle) >= 0) high = middle;
        else low = middle;
    }
    return high;
}
