import { rendererName } from './picture/graphics.js';
import { wrapDegrees } from './view_state.js';
import type { Viewer } from './viewer.js';

const kFrameCount = 60;
const kDegreesPerFrame = 360 / kFrameCount;

interface FrameTimes {
    medianMs: number;
    p95Ms: number;
    fps: number;
}

interface BenchmarkResult {
    renderer: string;
    mode: string;
    vertexCount: number;
    firstPictureMs: number;
    loadMs: number;
    orbit: FrameTimes;
    turn: FrameTimes;
}

/** What frames cost from the change to the last pixel: of 60 around the asset, and of 60 in which the light turns. */
export async function runBenchmark(viewer: Viewer, gl: WebGL2RenderingContext): Promise<BenchmarkResult> {
    await viewer.nextFrame();
    viewer.picture.finish();
    const firstPictureMs = performance.now();
    const { relightable } = viewer.shelf.find(viewer.assetIndexOf('first'))!;
    const orbit = await timeFrames(viewer, () => viewer.camera.controls.rotateLeft((kDegreesPerFrame * Math.PI) / 180));
    const turn = await timeFrames(viewer, () =>
        viewer.change({ turnDegrees: wrapDegrees(viewer.state.turnDegrees + kDegreesPerFrame) }),
    );
    return {
        renderer: rendererName(gl),
        mode: viewer.mode,
        vertexCount: relightable.asset.header.vertexCount,
        firstPictureMs,
        loadMs: viewer.shelf.loadMilliseconds,
        orbit,
        turn,
    };
}

async function timeFrames(viewer: Viewer, change: () => void): Promise<FrameTimes> {
    const milliseconds: number[] = [];
    for (let frame = 0; frame < kFrameCount; ++frame) {
        change();
        const begin = await viewer.nextFrame();
        viewer.picture.finish();
        milliseconds.push(performance.now() - begin);
    }
    milliseconds.sort((a, b) => a - b);
    const median = milliseconds[kFrameCount / 2];
    return { medianMs: median, p95Ms: milliseconds[Math.floor(0.95 * kFrameCount)], fps: 1000 / median };
}

/** A table for people, and the same as JSON in `data-result`. */
export function showBenchmark(result: BenchmarkResult): void {
    const table = document.createElement('table');
    table.id = 'benchmark';
    table.dataset.result = JSON.stringify(result);
    const { orbit, turn } = result;
    const timesOf = ({ medianMs, p95Ms, fps }: FrameTimes): string =>
        `${medianMs.toFixed(1)} ms, 95 % below ${p95Ms.toFixed(1)} ms, ${fps.toFixed(0)} frames a second`;
    const rows = [
        ['drawn by', `${result.renderer}, radiance summed on the ${result.mode.toUpperCase()}`],
        ['vertices', result.vertexCount.toLocaleString('en')],
        ['first picture', `${result.firstPictureMs.toFixed(0)} ms, of which ${result.loadMs.toFixed(0)} ms to read the asset`],
        ['camera turns', timesOf(orbit)],
        ['light turns', timesOf(turn)],
    ];
    for (const texts of rows) {
        const row = table.insertRow();
        for (const text of texts) row.insertCell().textContent = text;
    }
    document.body.append(table);
}
