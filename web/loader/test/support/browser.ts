import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync } from 'node:fs';
import { type Server, createServer } from 'node:http';
import type { AddressInfo } from 'node:net';
import { tmpdir } from 'node:os';
import { extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';

import { type OpenPage, openChromium } from '../../../support/chromium.js';

const root = fileURLToPath(new URL('../..', import.meta.url));
const packages = fileURLToPath(new URL('../../../node_modules', import.meta.url));
const golden = fileURLToPath(new URL('../../../../tests/asset/golden', import.meta.url));

const kPage = `<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,"><script type="importmap">{"imports": {
    "three": "/node_modules/three/build/three.module.js", "three/addons/": "/node_modules/three/examples/jsm/", "openprt-three": "/dist/index.js"
}}</script><script type="module" src="/test/browser/page.js"></script>`;

/**
 * A page that has the built package.
 *
 * @param folders  more of what the page may fetch, by the beginning of its path
 */
export async function openPage(folders: Record<string, string> = {}): Promise<OpenPage> {
    const dist = mkdtempSync(join(tmpdir(), 'openprt-three-'));
    execFileSync('node', [join(packages, 'typescript/bin/tsc'), '-p', join(root, 'tsconfig.build.json'), '--outDir', dist]);
    const server = await serve({ '/dist/': dist, '/golden/': golden, '/node_modules/': packages, '/test/': join(root, 'test'), ...folders });
    const opened = await openChromium(`http://127.0.0.1:${(server.address() as AddressInfo).port}/`);
    await opened.page.waitForFunction('window.isReady || window.failure', undefined, { timeout: 30000 });
    const close = async (): Promise<void> => {
        await opened.close();
        server.close();
    };
    return { ...opened, close };
}

function serve(folders: Record<string, string>): Promise<Server> {
    const types: Record<string, string> = { '.js': 'text/javascript', '.glb': 'model/gltf-binary' };
    const server = createServer((request, response) => {
        const path = normalize(decodeURIComponent(new URL(request.url!, 'http://page').pathname));
        if (path === '/') {
            response.writeHead(200, { 'Content-Type': 'text/html' }).end(kPage);
            return;
        }
        const prefix = Object.keys(folders).find((candidate) => path.startsWith(candidate));
        try {
            const bytes = readFileSync(join(folders[prefix!], path.slice(prefix!.length)));
            response.writeHead(200, { 'Content-Type': types[extname(path)] ?? 'application/octet-stream' }).end(bytes);
        } catch {
            response.writeHead(404).end();
        }
    });
    return new Promise((resolve) => server.listen(0, '127.0.0.1', () => resolve(server)));
}
