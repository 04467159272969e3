import { fileURLToPath } from 'node:url';

import { viteSingleFile } from 'vite-plugin-singlefile';
import { defineConfig } from 'vitest/config';

const loader = fileURLToPath(new URL('../loader/src/index.ts', import.meta.url));

export default defineConfig({
    plugins: [viteSingleFile()],
    resolve: { alias: { 'openprt-three': loader } },
    build: { target: 'es2022', modulePreload: { polyfill: false }, reportCompressedSize: false },
    test: { include: ['test/**/*.test.ts'], testTimeout: 120000, hookTimeout: 120000 },
});
