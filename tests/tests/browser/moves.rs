//! Moving sliders as fingers do, and what of it is measured: scripts for a page's asynchronous calls.

/// The slider of all schemes.
pub const FRICTION: &str = "#setup [data-pointer=\"/plant/friction/width_rad_s\"]";

/// Moves a field's slider by `step` and answers with three times in ms: until the figures are on their canvases, until the frame
/// that shows them has ended, and until the canvases as the page itself tells.
pub const MOVE: &str = "const [field, step, done] = arguments; const root = document.documentElement; \
    const slider = document.querySelector(field + ' input[type=range]'); \
    const { port1, port2 } = new MessageChannel(); const start = performance.now(); let drawn; \
    port1.onmessage = () => done([drawn, performance.now() - start, Number(root.dataset.lastLatencyMs)]); \
    const before = root.dataset.drawnGeneration; \
    new MutationObserver((_, observer) => { if (root.dataset.drawnGeneration === before) return; \
        observer.disconnect(); drawn = performance.now() - start; \
        requestAnimationFrame(() => port2.postMessage(null)); \
    }).observe(root, { attributes: true, attributeFilter: ['data-drawn-generation'] }); \
    slider.value = Number(slider.value) + step; slider.dispatchEvent(new Event('input', { bubbles: true }))";

/// Drags a field's slider at the rate of a screen's frames and answers with how often the first figure and the arms were drawn
/// until the last move, and with the lengths of tasks of 50 ms and more on the main thread until a second later.
pub const DRAG: &str = "const [field, moves, done] = arguments; const tasks = []; let n = 0; let drawn = 0; \
    const observer = new PerformanceObserver((list) => tasks.push(...list.getEntries().map(({ duration }) => duration))); \
    observer.observe({ type: 'longtask' }); \
    const slider = document.querySelector(field + ' input[type=range]'); \
    const card = [...document.querySelectorAll('figure-card')].find(({ inView }) => inView); \
    const arms = document.querySelector('arm-view'); const armsBefore = arms.drawings; \
    let at = card.drawnAt; \
    Object.defineProperty(card, 'drawnAt', { configurable: true, get: () => at, set: (now) => { at = now; drawn += 1; } }); \
    const timer = setInterval(() => { slider.value = 40 * Math.sin(n / 10); \
        slider.dispatchEvent(new Event('input', { bubbles: true })); \
        if (++n === moves) { clearInterval(timer); const drawings = [drawn, arms.drawings - armsBefore]; \
            setTimeout(() => { observer.disconnect(); done([drawings, tasks]); }, 1000); } }, 16)";
