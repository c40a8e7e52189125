//! Turns a placed grid into polylines: arrivals are spread, layers and channels get ordinates.

use super::channel::{TOUCHING, Wire, levels};
use super::grid::{Grid, LINE, Terminal};
use super::place::{push_right, room, straighten_outward};
use super::{Exit, Layout, Link, Node};

/// Room above the first and below the last horizontal line of a channel; arrow tips need more.
const ABOVE: f64 = 14.0;
const BELOW: f64 = 24.0;

/// Least distance of two arrivals on one box.
const ARRIVALS: f64 = 13.0;

/// How often edges on top of each other are moved apart.
const ATTEMPTS: usize = 60;
const STRAIGHT_ATTEMPTS: usize = 4;

/// Places and polylines of everything.
pub(super) fn route(grid: &mut Grid, nodes: &[Node], links: &[Link]) -> Layout {
    separate(grid);
    let tracks = Tracks::new(grid);
    let mut level_y = vec![0.0; grid.nets.len()];
    let mut layer_top = Vec::with_capacity(grid.layers.len());
    let mut y = 0.0;
    for (channel, nets) in grid.channels.iter().enumerate() {
        for net in nets {
            level_y[*net] = y + ABOVE + tracks.levels[*net] as f64 * LINE;
        }
        if !nets.is_empty() {
            y += ABOVE + BELOW + tracks.counts[channel].saturating_sub(1) as f64 * LINE;
        }
        if let Some(layer) = grid.layers.get(channel) {
            layer_top.push(y);
            y += layer_height(grid, layer, nodes);
        }
    }
    let corners: Vec<_> = (0..nodes.len())
        .map(|node| (grid.items[node].x, layer_top[grid.items[node].layer]))
        .collect();
    let routes = links.iter().enumerate().map(|(index, link)| {
        let mut points = leave(grid, index, link, corners[link.from]);
        for net in &grid.chains[index] {
            points.extend(tracks.ends[*net].map(|x| (x, level_y[*net])));
        }
        points.push((points.last().map_or(0.0, |last| last.0), corners[link.to].1));
        without_straight_corners(points)
    });
    let routes: Vec<_> = routes.collect();
    let right = grid.items.iter().map(|item| item.x + item.width);
    let lines = routes.iter().flatten().map(|point| point.0);
    Layout { width: right.chain(lines).fold(0.0, f64::max), height: y, corners, routes }
}

/// The first points of an edge: its exit and, on the right of a box, where it turns.
fn leave(grid: &Grid, index: usize, link: &Link, (x, y): (f64, f64)) -> Vec<(f64, f64)> {
    match link.exit {
        Exit::Below(dx, dy) => vec![(x + dx, y + dy)],
        Exit::Right(dx, dy) => {
            let turn = grid.turns[index].unwrap_or(dx);
            vec![(x + dx, y + dy), (x + turn, y + dy)]
        }
    }
}

/// Where the nets of a placed grid run.
struct Tracks {
    /// The abscissas of the ends of each net.
    ends: Vec<[f64; 2]>,
    /// The level of each net in its channel.
    levels: Vec<usize>,
    /// How many levels each channel has.
    counts: Vec<usize>,
}

impl Tracks {
    fn new(grid: &Grid) -> Tracks {
        let mut ends: Vec<_> =
            grid.nets.iter().map(|net| net.ends.map(|end| grid.x(&end))).collect();
        for (net, x) in arrivals(grid) {
            ends[net][1] = x;
        }
        let mut tracks = Tracks { ends, levels: vec![0; grid.nets.len()], counts: Vec::new() };
        for nets in &grid.channels {
            let wire = |net: &usize| {
                let [start, end] = grid.nets[*net].ends.map(|end| end.above);
                Wire { ends: [(tracks.ends[*net][0], start), (tracks.ends[*net][1], end)] }
            };
            let (levels, count) = levels(&nets.iter().map(wire).collect::<Vec<_>>());
            for (net, level) in nets.iter().zip(levels) {
                tracks.levels[*net] = level;
            }
            tracks.counts.push(count);
        }
        tracks
    }

    /// The first two ends of nets of a channel that lie on top of each other: one comes up from
    /// below to a level above that to which the other goes down.
    fn conflict(&self, grid: &Grid, nets: &[usize]) -> Option<[(Terminal, f64); 2]> {
        let ends = nets.iter().flat_map(|net| [(*net, 0), (*net, 1)]);
        let terminal = |(net, end): (usize, usize)| (grid.nets[net].ends[end], self.ends[net][end]);
        let (above, below): (Vec<_>, Vec<_>) =
            ends.partition(|(net, end)| grid.nets[*net].ends[*end].above);
        let pairs = below.iter().flat_map(|low| above.iter().map(move |high| (*low, *high)));
        let mut pairs = pairs.filter(|(low, high)| low.0 != high.0);
        let found = pairs.find(|(low, high)| {
            let near = (terminal(*low).1 - terminal(*high).1).abs() < TOUCHING + 1.0;
            near && self.levels[low.0] < self.levels[high.0]
        });
        found.map(|(low, high)| [terminal(low), terminal(high)])
    }
}

/// Moves items a little where two edges would lie on top of each other. Ways rather than boxes.
fn separate(grid: &mut Grid) {
    for attempt in 0..ATTEMPTS {
        let tracks = Tracks::new(grid);
        let conflicts = grid.channels.iter().filter_map(|nets| tracks.conflict(grid, nets));
        let conflicts: Vec<_> = conflicts.collect();
        if conflicts.is_empty() {
            break;
        }
        for [low, high] in conflicts {
            let is_way = grid.items[low.0.item].node.is_none();
            let (moved, other) = if is_way { (low, high) } else { (high, low) };
            move_away(grid, &moved.0, moved.1, other.1);
        }
        // Straight lines may conflict anew, so in the end only distance counts.
        if attempt < STRAIGHT_ATTEMPTS {
            straighten_outward(grid);
        }
    }
}

/// Moves the item of `end`, which is at `x`, as little as needed to be apart from `other`, and what
/// is on one line with it; where neighbours leave no room, to the right, and them too.
fn move_away(grid: &mut Grid, end: &Terminal, x: f64, other: f64) {
    let run = on_one_line(grid, end.item);
    let distance = TOUCHING + 2.0;
    let shifts = [other - distance - x, other + distance - x];
    let fits = |shift: &f64| {
        run.iter().all(|item| {
            let (left, right) = room(grid, *item);
            (left..=right).contains(&(grid.items[*item].x + shift))
        })
    };
    let best = shifts.into_iter().filter(fits).min_by(|a, b| a.abs().total_cmp(&b.abs()));
    for item in run {
        grid.items[item].x += best.unwrap_or(shifts[1]);
        push_right(grid, grid.items[item].layer);
    }
}

/// The ways of the same edge that continue an item straight up and down, itself included.
fn on_one_line(grid: &Grid, item: usize) -> Vec<usize> {
    let ways = grid.chains.iter().map(|chain| grid.ways(chain));
    let Some(ways) = ways.into_iter().find(|ways| ways.contains(&item)) else {
        return vec![item];
    };
    let x = grid.items[item].x;
    let runs = ways.split(|way| (grid.items[*way].x - x).abs() > 0.5);
    runs.into_iter().find(|run| run.contains(&item)).map_or_else(|| vec![item], <[_]>::to_vec)
}

fn layer_height(grid: &Grid, layer: &[usize], nodes: &[Node]) -> f64 {
    let heights =
        layer.iter().filter_map(|item| grid.items[*item].node).map(|node| nodes[node].height);
    heights.fold(0.0, f64::max)
}

/// The abscissas at which edges arrive, by net: in the order of where they come from, each as near
/// to that as the box and its neighbours allow.
fn arrivals(grid: &Grid) -> Vec<(usize, f64)> {
    let mut found = Vec::new();
    for node in 0..grid.items.len() {
        let tips = grid.chains.iter().filter_map(|chain| chain.last().copied());
        let mut tips: Vec<(usize, f64)> = tips
            .filter(|net| grid.nets[*net].ends[1].item == node)
            .map(|net| (net, grid.x(&grid.nets[net].ends[0])))
            .collect();
        let Some((net, _)) = tips.first().copied() else { continue };
        tips.sort_by(|a, b| a.1.total_cmp(&b.1));
        let room = arrival_range(grid, &grid.nets[net].ends[1]);
        found.extend((0..tips.len()).map(|place| (tips[place].0, spread(&tips, place, room))));
    }
    found
}

fn arrival_range(grid: &Grid, tip: &Terminal) -> (f64, f64) {
    let (left, right) = tip.arrival.unwrap_or((tip.offset, tip.offset));
    let x = grid.items[tip.item].x;
    (x + left, x + right)
}

/// The place of one of several arrivals in a range.
fn spread(tips: &[(usize, f64)], place: usize, (left, right): (f64, f64)) -> f64 {
    let gaps = (tips.len() - 1).max(1) as f64;
    let gap = ARRIVALS.min((right - left) / gaps);
    // Each wants its own abscissa, but leaves room for those before and after it.
    let before = (0..=place)
        .map(|other| tips[other].1.max(left + other as f64 * gap) + (place - other) as f64 * gap);
    let least = before.fold(f64::NEG_INFINITY, f64::max);
    least.min(right - (tips.len() - 1 - place) as f64 * gap)
}

/// Drops points that lie on the straight line between their neighbours, and repeated ones.
pub(super) fn without_straight_corners(points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    let mut kept: Vec<(f64, f64)> = Vec::with_capacity(points.len());
    let near = |a: f64, b: f64| (a - b).abs() < 0.5;
    for point in points {
        if let [.., before, last] = kept[..] {
            let vertical = near(before.0, last.0) && near(last.0, point.0);
            let horizontal = near(before.1, last.1) && near(last.1, point.1);
            if vertical || horizontal {
                kept.pop();
            }
        }
        if kept.last().is_none_or(|last| !near(last.0, point.0) || !near(last.1, point.1)) {
            kept.push(point);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::{spread, without_straight_corners};

    #[test]
    fn arrivals_stay_in_the_box_and_apart() {
        let tips = [(0, -50.0), (1, 30.0), (2, 32.0), (3, 900.0)];
        let places: Vec<_> = (0..4).map(|place| spread(&tips, place, (0.0, 100.0))).collect();
        assert_eq!(places, [0.0, 30.0, 43.0, 100.0]);
    }

    #[test]
    fn too_many_arrivals_share_the_room() {
        let tips: Vec<_> = (0..11).map(|net| (net, 500.0)).collect();
        let places: Vec<_> = (0..11).map(|place| spread(&tips, place, (0.0, 100.0))).collect();
        assert!(places.windows(2).all(|pair| pair[1] - pair[0] > 9.9), "{places:?}");
    }

    #[test]
    fn corners_without_a_turn_are_dropped() {
        let points = vec![(0.0, 0.0), (0.0, 5.0), (0.0, 5.0), (0.0, 9.0), (4.0, 9.0)];
        assert_eq!(without_straight_corners(points), [(0.0, 0.0), (0.0, 9.0), (4.0, 9.0)]);
    }
}
