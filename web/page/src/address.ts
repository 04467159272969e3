import { formatHash, parseHash } from './view_state.js';
import type { Viewer } from './viewer.js';

// Browsers refuse more than some hundred changes in half a minute.
const kLeastMilliseconds = 300;

/** Keeps the address and what is shown the same, so that a view can be sent to somebody. */
export function keepInAddress(viewer: Viewer): void {
    let written = location.hash;
    let writtenAt = -Infinity;
    let timer = 0;
    const write = (): void => {
        timer = 0;
        const hash = formatHash(viewer.state);
        if (hash === written) return;
        written = hash;
        writtenAt = performance.now();
        history.replaceState(null, '', hash || location.pathname + location.search);
    };
    viewer.onFrame(() => {
        const wait = writtenAt + kLeastMilliseconds - performance.now();
        if (wait <= 0) write();
        else if (timer === 0) timer = window.setTimeout(write, wait);
    });
    window.addEventListener('hashchange', () => {
        written = location.hash;
        viewer.replace(parseHash(location.hash));
    });
}
