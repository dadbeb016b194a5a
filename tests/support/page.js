// SPDX-FileCopyrightText: The Impinge authors
// SPDX-License-Identifier: Apache-2.0

// node page.js CHROMIUM PAGE PROFILE: opens a page of `impinge view` in a browser without a screen,
// uses it as a reader would, and prints what it shows, one JSON object.

const { chromium } = require('playwright-core');
const [executablePath, page, profile] = process.argv.slice(2);
const args = ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
    '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update',
    '--disable-sync'];

// In the page: of a canvas, how many pixels are not as the one in its corner, how many are nearly this
// colour, how blue all are, and how bright the corner is.
function count([selector, wanted]) {
    const shown = document.querySelector(selector), copy = document.createElement('canvas');
    copy.width = shown.width, copy.height = shown.height;
    const context = copy.getContext('2d');
    context.drawImage(shown, 0, 0);
    const rgba = context.getImageData(0, 0, copy.width, copy.height).data;
    const sum = { drawn: 0, wanted: 0, blue: 0, ground: rgba[0] + rgba[1] + rgba[2] };
    for (let k = 0; k < rgba.length; k += 4) {
        if ([0, 1, 2].some(i => Math.abs(rgba[k + i] - rgba[i]) > 5)) ++sum.drawn;
        if (wanted.every((c, i) => Math.abs(rgba[k + i] - c) < 12)) ++sum.wanted;
        sum.blue += rgba[k + 2] - rgba[k];
    }
    return sum;
}

// In the page: what does not fit the window, and what has no name.
function faults() {
    const found = [];
    if (document.documentElement.scrollWidth > window.innerWidth) found.push('wider than the window');
    for (const e of document.querySelectorAll('button, input, label, #now, #legend > *, canvas')) {
        const box = e.getBoundingClientRect();
        if (box.width > 0 && (box.left < 0 || box.right > window.innerWidth + 0.5)) found.push(e.outerHTML + ' is cut off');
        if (e.tagName === 'CANVAS' && !e.hidden && !e.getAttribute('aria-label')) found.push('a canvas has no name');
    }
    return found;
}

async function use(tab) {
    const red = [214, 26, 28], scene = '#scene canvas';
    const time = () => tab.evaluate(() => Number(document.body.dataset.t));
    const playing = () => tab.textContent('#play').then(text => text === 'Pause');
    const now = async () => ({
        t: await time(), told: await tab.textContent('#now'), event: await tab.textContent('#event'),
        announced: await tab.getAttribute('#time', 'aria-valuetext'),
        veiled: await tab.evaluate(() => document.body.dataset.veiled), ...await tab.evaluate(count, [scene, red])
    });
    const seen = { title: await tab.title(), names: await tab.locator('#names li').allTextContents() };
    seen.first = await now();
    if (await tab.isVisible('#regions')) {
        await tab.click('#regions');
        seen.regions = await tab.evaluate(count, [scene, red]);
        await tab.click('#regions');
    }
    await tab.evaluate(() => {
        const slider = document.getElementById('time');
        slider.value = 0.25;
        slider.dispatchEvent(new Event('input'));
    });
    seen.scrubbed = await now();
    await tab.click('#play');
    await tab.waitForFunction(t => Number(document.body.dataset.t) > t, seen.scrubbed.t);
    await tab.click('#play');
    seen.played = await time();
    await tab.focus(scene);
    await tab.keyboard.press('Space');
    seen.space = await playing();
    await tab.waitForFunction(t => Number(document.body.dataset.t) !== t, seen.played);
    await tab.keyboard.press('Space');
    seen.stopped = !await playing();
    if (await tab.isVisible('#gap')) {
        // The plot's area begins 52 pixels from the left and ends 12 from the right.
        const box = await tab.locator('#gap').boundingBox();
        seen.plot = await tab.evaluate(count, ['#gap', red]);
        await tab.click('#gap', { position: { x: 52 + 0.75 * (box.width - 64), y: 40 } });
        seen.clicked = await time();
        await tab.keyboard.press('ArrowRight');
        seen.right = await time();
    }
    seen.events = [];
    if (await tab.isVisible('#next')) {
        await tab.evaluate(() => go(t0));
        for (let before = NaN; before !== await time();) {
            before = await time();
            await tab.click('#next');
            seen.events.push(await now());
        }
    }
    await tab.click('#spot');
    seen.again = await time();
    const before = await tab.screenshot();
    await tab.mouse.move(400, 200);
    await tab.mouse.down();
    await tab.mouse.move(500, 260, { steps: 4 });
    await tab.mouse.up();
    seen.turned = !before.equals(await tab.screenshot());
    seen.faults = await tab.evaluate(faults);
    await tab.setViewportSize({ width: 360, height: 640 });
    await tab.waitForFunction(() => document.querySelector('#scene canvas').clientWidth <= 360);
    seen.narrow = { faults: await tab.evaluate(faults), ...await tab.evaluate(count, [scene, red]) };
    await tab.emulateMedia({ colorScheme: 'dark' });
    await tab.evaluate(() => show());
    seen.dark = await tab.evaluate(count, [scene, red]);
    return seen;
}

async function withoutScript(browser, address) {
    const context = await browser.newContext({ javaScriptEnabled: false });
    const tab = await context.newPage();
    await tab.goto(address);
    const text = await tab.locator('noscript').first().innerText();
    await context.close();
    return text;
}

(async () => {
    const browser = await chromium.launch({ executablePath, args: [...args, '--user-data-dir=' + profile], headless: true })
        .catch(() => chromium.launch({ executablePath, args, headless: true }));
    const context = await browser.newContext({ viewport: { width: 800, height: 600 }, colorScheme: 'light' });
    const tab = await context.newPage(), errors = [], asked = [], address = 'file://' + page;
    tab.on('pageerror', error => errors.push(error.message));
    tab.on('request', request => asked.push(request.url()));
    await tab.goto(address);
    await tab.waitForSelector('body[data-state]');
    const state = await tab.evaluate(() => document.body.dataset.state);
    const seen = state === 'ready' ? await use(tab) : {};
    seen.noscript = await withoutScript(browser, address);
    console.log(JSON.stringify({ state, ...seen, errors, asked: asked.length }));
    await browser.close();
})();
