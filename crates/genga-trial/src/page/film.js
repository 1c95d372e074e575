// Films on the stage, by the clock of the screen: a slow machine leaves koma out and keeps the time.
let wasHidden = false;
document.addEventListener("visibilitychange", () => { wasHidden ||= document.hidden; });

// Plays a film and gives the number of koma that never were on screen. Where nobody could see it, it begins anew.
function play(film, koma_rate, show) {
  return new Promise((done) => {
    let began = null;
    let shown = -1;
    let dropped = 0;
    const tick = (now) => {
      if (began === null || wasHidden) [began, shown, dropped, wasHidden] = [now, -1, 0, false];
      // A refresh that comes a hair before its koma is that koma's.
      const koma = Math.floor(((now - began) / 1000) * koma_rate + 1e-3);
      if (koma >= film.length) return done(dropped + film.length - 1 - shown);
      if (koma !== shown) {
        dropped += koma - shown - 1;
        shown = koma;
        show(film[koma]);
      }
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  });
}

// Waits by the same clock.
function rest(milliseconds) {
  return new Promise((done) => {
    let began = null;
    const tick = (now) => {
      began ??= now;
      if (now - began >= milliseconds) done();
      else requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  });
}

