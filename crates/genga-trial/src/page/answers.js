// What a person has answered: kept in the browser, saved as CSV.
class Answers {
  constructor(plan) {
    [this.plan, this.key] = [plan, `trial-${plan.trial}`];
    this.isKept = true;
    this.state = this.kept() ?? this.fresh();
  }

  kept() {
    try {
      return JSON.parse(localStorage.getItem(this.key));
    } catch {
      this.isKept = false;
      return null;
    }
  }

  // Another person. Whoever asks can give numbers, as in index.html?seed=12.
  fresh() {
    const [person, lot] = crypto.getRandomValues(new Uint32Array(2));
    const given = new URLSearchParams(location.search).get("seed");
    const seed = /^\d{1,9}$/.test(given ?? "") ? Number(given) : lot;
    return { person: person.toString(16).padStart(8, "0"), seed, eye: "", language: "", screen: null, answers: [] };
  }

  keep() {
    try {
      localStorage.setItem(this.key, JSON.stringify(this.state));
    } catch {
      this.isKept = false;
    }
  }

  add(answer) {
    this.state.answers.push(answer);
    this.keep();
  }

  forget() {
    try {
      localStorage.removeItem(this.key);
    } catch {
      this.isKept = false;
    }
    this.state = this.fresh();
  }

  csv(all) {
    const { person, seed, eye, language, answers } = this.state;
    const of = { schema: this.plan.schema, trial: this.plan.trial, koma_rate: this.plan.koma_rate, person, seed, eye, language, of: all };
    const cell = (text) => (/[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
    const row = (answer) => this.plan.columns.map((column) => cell(String({ ...of, ...answer }[column])));
    return [this.plan.columns, ...answers.map(row)].map((cells) => cells.join(",") + "\n").join("");
  }

  save(all) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([this.csv(all)], { type: "text/csv" }));
    link.download = `answers-${this.state.person}.csv`;
    link.click();
    URL.revokeObjectURL(link.href);
  }
}

