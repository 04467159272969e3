import { defineConfig } from 'vitest/config';

export default defineConfig({
    appType: 'mpa', // a wrong address is an error, not this page once more
    base: './',
    build: { target: 'es2022' },
    test: { include: ['test/**/*.test.ts'], testTimeout: 60000, hookTimeout: 60000 },
});
