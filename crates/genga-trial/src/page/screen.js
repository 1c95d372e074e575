// What the screen can show, measured before anything is asked.
const MEASURED = 2000;

// Refreshes a second, and the share of refreshes that came more than a koma after the one before.
function measured(times, koma_rate) {
  const gaps = times.slice(1).map((time, at) => time - times[at]).sort((a, b) => a - b);
  if (gaps.length === 0) return { hz: 0, slow: 1 };
  const median = gaps[Math.floor(gaps.length / 2)];
  const koma = 1000 / koma_rate;
  // Clocks of browsers are rounded to a millisecond at the worst.
  const slow = gaps.filter((gap) => gap > koma + 1).length / gaps.length;
  return { hz: Math.round(10000 / Math.max(median, 0.1)) / 10, slow: Math.round(slow * 1e4) / 1e4 };
}

const isGood = ({ hz, slow }, { screen }) => hz >= screen.least_hz && slow <= screen.most_slow;

// Looks at the clock of the screen for two seconds; `tell` hears how far that is.
function measure(koma_rate, tell) {
  return new Promise((done) => {
    const times = [];
    const tick = (now) => {
      times.push(now);
      tell(Math.min(1, (now - times[0]) / MEASURED));
      if (now - times[0] < MEASURED) requestAnimationFrame(tick);
      // The first refreshes still belong to the page that was before.
      else done(measured(times.slice(5), koma_rate));
    };
    requestAnimationFrame(tick);
  });
}

