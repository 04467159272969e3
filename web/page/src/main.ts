import './page.css';

import { keepInAddress } from './address.js';
import { runBenchmark, showBenchmark } from './benchmark.js';
import { makeDefaultLight } from './default_light.js';
import { Divider } from './divider.js';
import { FileDrop } from './file_drop.js';
import { LightGesture } from './gestures.js';
import { isSoftwareRasteriser, openGraphics } from './graphics.js';
import { takeLight } from './lights.js';
import { Messages } from './messages.js';
import { readPageData } from './page_data.js';
import { Panel } from './panel.js';
import { parseHash } from './view_state.js';
import { Viewer } from './viewer.js';

const kNoGraphics = 'This page draws with WebGL2, which this browser does not have or has turned off.';
const kNoData = 'This page is empty: prt web ASSET -o page.html makes one with an asset in it. Drop a baked asset here to see it.';

function elementOf<Kind extends HTMLElement>(id: string): Kind {
    return document.getElementById(id) as Kind;
}

function start(): void {
    const messages = new Messages(elementOf('message-box'), elementOf('message'), elementOf('message-dismiss'));
    const canvas = elementOf<HTMLCanvasElement>('picture');
    document.documentElement.dataset.state = 'loading';
    const gl = openGraphics(canvas);
    if (!gl) {
        document.documentElement.dataset.state = 'failed';
        messages.say(kNoGraphics);
        return;
    }
    const data = readPageData();
    document.title = data.assets.map(({ name }) => name).join(', ') || document.title;
    const query = new URLSearchParams(location.search);
    const asked = query.get('mode');
    const mode = asked === 'cpu' || asked === 'gpu' ? asked : isSoftwareRasteriser(gl) ? 'cpu' : 'gpu';
    document.body.classList.toggle('slow', mode === 'cpu'); // what is behind the panel is not blurred then
    const lights = data.lights.length > 0 ? data.lights.map(takeLight) : [makeDefaultLight()];
    const viewer = new Viewer(canvas, gl, data, lights, mode, messages);
    viewer.replace(parseHash(location.hash));
    keepInAddress(viewer);
    new Divider(canvas, viewer);
    const files = new FileDrop(viewer, messages);
    new Panel(viewer, new LightGesture(canvas, viewer), () => files.ask()).refresh();
    if (data.assets.length === 0) messages.say(kNoData);
    else if (query.has('benchmark')) void runBenchmark(viewer, gl).then(showBenchmark);
}

start();
