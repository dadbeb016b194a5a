// SPDX-FileCopyrightText: The Impinge authors
// SPDX-License-Identifier: Apache-2.0

// node page.js CHROMIUM PAGE PROFILE: opens a page of `impinge view` in a browser without a screen,
// uses it as a reader would, and prints what it shows, one JSON object.

const { chromium } = require('playwright-core');
const [executablePath, page, profile] = process.argv.slice(2);
const args = ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
    '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update',
    '--disable-sync'];

// How many pixels of the scene are not white, how many are nearly this colour, and how blue all are.
function count(wanted) {
    const shown = document.querySelector('#scene canvas'), copy = document.createElement('canvas');
    copy.width = shown.width, copy.height = shown.height;
    const context = copy.getContext('2d');
    context.drawImage(shown, 0, 0);
    const rgba = context.getImageData(0, 0, copy.width, copy.height).data, sum = { drawn: 0, wanted: 0, blue: 0 };
    for (let k = 0; k < rgba.length; k += 4) {
        if (rgba[k] < 250 || rgba[k + 1] < 250 || rgba[k + 2] < 250) ++sum.drawn;
        if (wanted.every((c, i) => Math.abs(rgba[k + i] - c) < 12)) ++sum.wanted;
        sum.blue += rgba[k + 2] - rgba[k];
    }
    return sum;
}

(async () => {
    const browser = await chromium.launchPersistentContext(profile, {
        executablePath, args, headless: true, viewport: { width: 800, height: 600 }
    });
    const tab = await browser.newPage(), errors = [], asked = [];
    tab.on('pageerror', error => errors.push(error.message));
    tab.on('request', request => asked.push(request.url()));
    await tab.goto('file://' + page);
    await tab.waitForSelector('body[data-state]');
    const told = () => tab.textContent('#told'), time = () => tab.evaluate(() => Number(document.body.dataset.t));
    const seen = { state: await tab.evaluate(() => document.body.dataset.state) };
    if (seen.state === 'ready') {
        const red = [214, 26, 28];
        seen.contact = { t: await time(), told: await told(), ...await tab.evaluate(count, red) };
        await tab.click('#regions');
        seen.regions = await tab.evaluate(count, red);
        await tab.click('#regions');
        await tab.evaluate(() => {
            const slider = document.getElementById('time');
            slider.value = 0.25;
            slider.dispatchEvent(new Event('input'));
        });
        seen.scrubbed = { t: await time(), told: await told() };
        await tab.click('#play');
        await tab.waitForFunction(() => Number(document.body.dataset.t) > 0.26);
        await tab.click('#play');
        seen.played = await time();
        await tab.click('#contact');
        seen.again = await time();
        const before = await tab.screenshot();
        await tab.mouse.move(400, 200);
        await tab.mouse.down();
        await tab.mouse.move(500, 260, { steps: 4 });
        await tab.mouse.up();
        seen.turned = !before.equals(await tab.screenshot());
    }
    console.log(JSON.stringify({ ...seen, errors, asked: asked.length }));
    await browser.close();
})();
