import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync } from 'node:fs';
import { type Server, createServer } from 'node:http';
import type { AddressInfo } from 'node:net';
import { tmpdir } from 'node:os';
import { extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';
import { type Browser, type Page, chromium } from 'playwright-core';

/** Debian's; another may be named by CHROMIUM. */
const kChromium = process.env.CHROMIUM ?? '/usr/bin/chromium';
export const hasBrowser = existsSync(kChromium);

const root = fileURLToPath(new URL('../..', import.meta.url));
const golden = fileURLToPath(new URL('../../../../tests/asset/golden', import.meta.url));

const kPage = `<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,"><script type="importmap">{"imports": {
    "three": "/node_modules/three/build/three.module.js", "three/addons/": "/node_modules/three/examples/jsm/", "openprt-three": "/dist/index.js"
}}</script><script type="module" src="/test/browser/page.js"></script>`;

/** A page in Chromium that has the built package, and what was said on its console. */
export interface OpenPage {
    page: Page;
    complaints: string[];
    close(): Promise<void>;
}

/** @param folders  more of what the page may fetch, by the beginning of its path */
export async function openPage(folders: Record<string, string> = {}): Promise<OpenPage> {
    const dist = mkdtempSync(join(tmpdir(), 'openprt-three-'));
    execFileSync('node', [join(root, 'node_modules/typescript/bin/tsc'), '-p', join(root, 'tsconfig.build.json'), '--outDir', dist]);
    const server = await serve({ '/dist/': dist, '/golden/': golden, '/node_modules/': join(root, 'node_modules'), '/test/': join(root, 'test'), ...folders });
    const browser: Browser = await chromium.launch({ executablePath: kChromium, args: ['--no-sandbox'] });
    const page = await browser.newPage();
    const complaints: string[] = [];
    page.on('pageerror', (error) => complaints.push(String(error)));
    page.on('console', (message) => {
        if (['error', 'warning'].includes(message.type()) && !message.text().includes('GPU stall due to ReadPixels')) complaints.push(message.text());
    });
    await page.goto(`http://127.0.0.1:${(server.address() as AddressInfo).port}/`);
    await page.waitForFunction('window.isReady || window.failure', undefined, { timeout: 30000 });
    return {
        page,
        complaints,
        close: async () => {
            await browser.close();
            server.close();
        },
    };
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
