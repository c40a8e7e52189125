//! Ways for edges between boxes that stand anywhere.
//!
//! One edge after the other takes the cheapest way over a grid: short, with few bends and
//! crossings, never on top of another edge and never through a box unless boxes leave no gap.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::route::without_straight_corners;
use super::{Exit, Link, Node};

/// Distance of the grid's lines in pixels.
const PITCH: f64 = 12.0;

/// Least distance between an edge that passes and a box.
const CLEAR: f64 = 9.0;

/// Room for the tip of an arrow above a box.
const TIP: f64 = 16.0;

/// What a bend, a crossing, a step on top of another edge and a step through a box cost, in steps.
const BEND: u32 = 6;
const CROSSING: u32 = 4;
const ON_TOP: u32 = 300;
const THROUGH: u32 = 2000;

/// Free lines around everything.
const MARGIN: usize = 8;

/// The corners of each link's polyline, start and tip included.
pub(super) fn route(
    nodes: &[Node],
    links: &[Link],
    corners: &[(f64, f64)],
) -> Vec<Vec<(f64, f64)>> {
    let mut maze = Maze::new(nodes, links.len(), corners);
    // Short edges first: long ones find a way around them.
    let length = |link: &Link| {
        let ((ax, ay), (bx, by)) = (corners[link.from], corners[link.to]);
        (ax - bx).abs() + (ay - by).abs()
    };
    let mut order: Vec<_> = (0..links.len()).collect();
    order.sort_by(|a, b| length(&links[*a]).total_cmp(&length(&links[*b])));
    let mut routes = vec![Vec::new(); links.len()];
    for index in order {
        let link = &links[index];
        let ends = Ends::new(&maze, link, nodes, corners);
        let cells = maze.find(&ends);
        maze.occupy(&cells);
        routes[index] = ends.polyline(&maze, &cells);
    }
    routes
}

/// A place of the grid with the direction in which an edge comes to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Cell {
    column: usize,
    row: usize,
    upright: bool,
}

struct Maze {
    left: f64,
    top: f64,
    columns: usize,
    rows: usize,
    /// Whether a place lies in or too near to a box.
    blocked: Vec<bool>,
    /// Whether an edge passes a place, by direction; one that bends there does so in both.
    taken: [Vec<bool>; 2],
}

/// Where an edge may start and end.
struct Ends {
    exit: (f64, f64),
    first: Cell,
    /// Row and columns of the goals.
    row: usize,
    columns: (usize, usize),
    tip: f64,
}

impl Maze {
    fn new(nodes: &[Node], links: usize, corners: &[(f64, f64)]) -> Maze {
        let margin = (MARGIN + links / 8) as f64 * PITCH;
        let boxes = || corners.iter().zip(nodes);
        let left = corners.iter().map(|corner| corner.0).fold(f64::INFINITY, f64::min) - margin;
        let top = corners.iter().map(|corner| corner.1).fold(f64::INFINITY, f64::min) - margin;
        let right = boxes().map(|((x, _), node)| x + node.width).fold(left, f64::max) + margin;
        let bottom = boxes().map(|((_, y), node)| y + node.height).fold(top, f64::max) + margin;
        let columns = ((right - left) / PITCH).ceil() as usize + 1;
        let rows = ((bottom - top) / PITCH).ceil() as usize + 1;
        let (blocked, free) = (vec![false; columns * rows], vec![false; columns * rows]);
        let mut maze = Maze { left, top, columns, rows, blocked, taken: [free.clone(), free] };
        for (corner, node) in boxes() {
            maze.block(*corner, node);
        }
        maze
    }

    fn block(&mut self, (x, y): (f64, f64), node: &Node) {
        let within = |from: f64, length: f64, line: f64, before: f64| {
            (from - before < line) && (line < from + length + CLEAR)
        };
        for row in 0..self.rows {
            if !within(y, node.height, self.y(row), TIP) {
                continue;
            }
            for column in 0..self.columns {
                if within(x, node.width, self.x(column), CLEAR) {
                    let place = self.place(column, row);
                    self.blocked[place] = true;
                }
            }
        }
    }

    fn x(&self, column: usize) -> f64 {
        self.left + column as f64 * PITCH
    }

    fn y(&self, row: usize) -> f64 {
        self.top + row as f64 * PITCH
    }

    /// The line nearest to an abscissa.
    fn column(&self, x: f64) -> usize {
        (((x - self.left) / PITCH).round().max(0.0) as usize).min(self.columns - 1)
    }

    /// The line nearest to an ordinate.
    fn row(&self, y: f64) -> usize {
        (((y - self.top) / PITCH).round().max(0.0) as usize).min(self.rows - 1)
    }

    fn place(&self, column: usize, row: usize) -> usize {
        row * self.columns + column
    }

    fn state(&self, cell: Cell) -> usize {
        2 * self.place(cell.column, cell.row) + usize::from(cell.upright)
    }

    /// The cheapest way from the first cell to a goal, both included.
    fn find(&self, ends: &Ends) -> Vec<Cell> {
        let mut best = vec![u32::MAX; 2 * self.columns * self.rows];
        let mut from: Vec<Option<Cell>> = vec![None; best.len()];
        let mut open = BinaryHeap::new();
        best[self.state(ends.first)] = 0;
        open.push(Reverse((self.distance(ends, ends.first), ends.first)));
        while let Some(Reverse((estimate, cell))) = open.pop() {
            let cost = best[self.state(cell)];
            if estimate > cost + self.distance(ends, cell) {
                continue;
            }
            if ends.reached(cell) {
                return self.way_back(&from, cell);
            }
            for next in self.neighbours(cell) {
                let sum = cost + self.step(cell, next);
                let state = self.state(next);
                if sum < best[state] {
                    best[state] = sum;
                    from[state] = Some(cell);
                    open.push(Reverse((sum + self.distance(ends, next), next)));
                }
            }
        }
        vec![ends.first]
    }

    fn way_back(&self, from: &[Option<Cell>], end: Cell) -> Vec<Cell> {
        let before = |cell: &Cell| from[self.state(*cell)];
        let mut way: Vec<_> = std::iter::successors(Some(end), before).collect();
        way.reverse();
        way
    }

    /// The least cost that is left.
    fn distance(&self, ends: &Ends, cell: Cell) -> u32 {
        let (least, most) = ends.columns;
        let across = least.saturating_sub(cell.column) + cell.column.saturating_sub(most);
        (across + cell.row.abs_diff(ends.row)) as u32
    }

    fn neighbours(&self, cell: Cell) -> impl Iterator<Item = Cell> {
        let Cell { column, row, .. } = cell;
        let upright = |row: Option<usize>| row.map(|row| Cell { column, row, upright: true });
        let level =
            |column: Option<usize>| column.map(|column| Cell { column, row, upright: false });
        let right = Some(column + 1).filter(|column| *column < self.columns);
        let below = Some(row + 1).filter(|row| *row < self.rows);
        let around = [
            upright(row.checked_sub(1)),
            upright(below),
            level(column.checked_sub(1)),
            level(right),
        ];
        around.into_iter().flatten()
    }

    fn step(&self, cell: Cell, next: Cell) -> u32 {
        let place = self.place(next.column, next.row);
        let taken = |upright: bool| self.taken[usize::from(upright)][place];
        let mut cost = 1;
        if self.blocked[place] {
            cost += THROUGH;
        }
        if taken(next.upright) {
            cost += ON_TOP;
        } else if taken(!next.upright) {
            cost += CROSSING;
        }
        if cell.upright != next.upright {
            cost += BEND;
            // The bend takes the place where it is in both directions.
            let corner = self.place(cell.column, cell.row);
            if self.taken[usize::from(next.upright)][corner] {
                cost += ON_TOP;
            }
        }
        cost
    }

    fn occupy(&mut self, cells: &[Cell]) {
        for (index, cell) in cells.iter().enumerate() {
            let place = self.place(cell.column, cell.row);
            self.taken[usize::from(cell.upright)][place] = true;
            if let Some(next) = cells.get(index + 1) {
                self.taken[usize::from(next.upright)][place] = true;
            }
        }
    }
}

impl Ends {
    fn new(maze: &Maze, link: &Link, nodes: &[Node], corners: &[(f64, f64)]) -> Ends {
        let ((x, y), from) = (corners[link.from], &nodes[link.from]);
        let (exit, first) = match link.exit {
            Exit::Below(dx, dy) => {
                let row = maze.row(y + from.height + CLEAR + PITCH / 2.0);
                let column = maze.column(x + dx);
                ((x + dx, y + dy), Cell { column, row, upright: true })
            }
            Exit::Right(dx, dy) => {
                let column = maze.column(x + from.width + CLEAR + PITCH / 2.0);
                let row = maze.row(y + dy);
                ((x + dx, y + dy), Cell { column, row, upright: false })
            }
        };
        let ((x, y), (left, right)) = (corners[link.to], nodes[link.to].entry);
        let columns = (maze.column(x + left + PITCH / 2.0), maze.column(x + right - PITCH / 2.0));
        // The last line that is free above the box, so that the arrow comes down to it.
        let row = maze.row(y - TIP - PITCH / 2.0);
        // A narrow place has one line at most.
        let columns = if columns.0 <= columns.1 { columns } else { (columns.1, columns.1) };
        Ends { exit, first, row, columns, tip: y }
    }

    /// The arrow must come to its tip from above.
    fn reached(&self, cell: Cell) -> bool {
        cell.row == self.row
            && cell.upright
            && (self.columns.0..=self.columns.1).contains(&cell.column)
    }

    /// The way in pixels, its first straight part on the line of the exit.
    fn polyline(&self, maze: &Maze, cells: &[Cell]) -> Vec<(f64, f64)> {
        let mut points = vec![self.exit];
        let mut along = true;
        for cell in cells {
            along &= cell.upright == self.first.upright;
            let (mut x, mut y) = (maze.x(cell.column), maze.y(cell.row));
            if along && self.first.upright {
                x = self.exit.0;
            } else if along {
                y = self.exit.1;
            }
            points.push((x, y));
        }
        let x = points.last().map_or(self.exit.0, |last| last.0);
        points.push((x, self.tip));
        without_straight_corners(points)
    }
}
