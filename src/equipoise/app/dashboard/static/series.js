/**
 * The newest rows of one series, in a ring of fixed size, so that memory stays the same for ever.
 * Column 0 is bench time (s), which never decreases. Rows are numbered from the oldest kept.
 */
export class Series {
  /**
   * @param {number} columns  with time and, where there are some, standard deviations
   * @param {number} capacity  rows
   */
  constructor(columns, capacity) {
    this.capacity = capacity;
    this.kept = Array.from({ length: columns }, () => new Float64Array(capacity));
    this.received = 0;
  }

  get rows() {
    return Math.min(this.received, this.capacity);
  }

  /** @param {Float64Array} data  whole rows, row-major */
  push(data) {
    const columns = this.kept.length;
    if (data.length % columns) throw new RangeError(`${data.length} numbers in rows of ${columns}`);
    for (let i = 0; i < data.length; i += columns) {
      const place = this.received % this.capacity;
      for (let c = 0; c < columns; c++) this.kept[c][place] = data[i + c];
      this.received++;
    }
  }

  /** @returns {number} */
  at(row, column) {
    return this.kept[column][(this.received - this.rows + row) % this.capacity];
  }

  /** @returns {number[]} a row with its time */
  row(row) {
    return this.kept.map((_, column) => this.at(row, column));
  }

  /** @returns {number[]|null} the newest row with its time */
  last() {
    return this.rows ? this.row(this.rows - 1) : null;
  }

  /** @returns {number} the first row that is not before `t` */
  firstFrom(t) {
    return this.firstWhere((time) => time >= t);
  }

  /** @returns {number} the first row that is after `t` */
  firstAfter(t) {
    return this.firstWhere((time) => time > t);
  }

  firstWhere(reached) {
    let low = 0;
    let high = this.rows;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (reached(this.at(middle, 0))) high = middle;
      else low = middle + 1;
    }
    return low;
  }
}
