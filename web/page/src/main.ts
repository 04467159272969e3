import './page.css';

import { keepInAddress } from './address.js';
import type { Mode } from './assets/load_asset.js';
import { runBenchmark, showBenchmark } from './benchmark.js';
import { Divider } from './interface/divider.js';
import { FileDrop } from './interface/file_drop.js';
import { LightGesture } from './interface/gestures.js';
import { Messages, sentenceOf } from './interface/messages.js';
import { Panel } from './interface/panel.js';
import { makeDefaultLight } from './lights/default_light.js';
import { takeLight } from './lights/lights.js';
import { readPageData } from './page_data.js';
import { isSoftwareRasteriser, openGraphics } from './picture/graphics.js';
import { parseHash } from './view_state.js';
import { Viewer } from './viewer.js';

const kNoGraphics = 'This page draws with WebGL2, which this browser does not have or has turned off.';
const kNoData = 'This page is empty: prt web ASSET -o page.html makes one with an asset in it. Drop a baked asset here to see it.';

function elementOf<Kind extends HTMLElement>(id: string): Kind {
    return document.getElementById(id) as Kind;
}

function tellFailed(messages: Messages, sentence: string): void {
    document.documentElement.dataset.state = 'failed';
    messages.say(sentence);
}

function start(messages: Messages): void {
    const canvas = elementOf<HTMLCanvasElement>('picture');
    const gl = openGraphics(canvas);
    if (!gl) return tellFailed(messages, kNoGraphics);
    const query = new URLSearchParams(location.search);
    const data = readPageData();
    document.title = data.assets.map(({ name }) => name).join(', ') || document.title;
    const lights = data.lights.length > 0 ? data.lights.map(takeLight) : [makeDefaultLight()];
    const viewer = new Viewer(canvas, gl, data, lights, chooseMode(query.get('mode'), gl), messages);
    viewer.replace(parseHash(location.hash));
    keepInAddress(viewer);
    new Divider(canvas, viewer);
    const files = new FileDrop(viewer, messages);
    new Panel(viewer, new LightGesture(canvas, viewer), () => files.ask()).refresh();
    document.body.classList.toggle('slow', viewer.mode === 'cpu'); // what is behind the panel is not blurred then
    if (data.assets.length === 0) messages.say(kNoData);
    else if (query.has('benchmark')) void runBenchmark(viewer, gl).then(showBenchmark);
}

/** Where radiance is summed, unless the address asks for one. */
function chooseMode(asked: string | null, gl: WebGL2RenderingContext): Mode {
    if (asked === 'cpu' || asked === 'gpu') return asked;
    return isSoftwareRasteriser(gl) ? 'cpu' : 'gpu';
}

document.documentElement.dataset.state = 'loading';
const messages = new Messages(elementOf('message-box'), elementOf('message'), elementOf('message-dismiss'));
try {
    start(messages);
} catch (error) {
    tellFailed(messages, sentenceOf('This page', error));
}
