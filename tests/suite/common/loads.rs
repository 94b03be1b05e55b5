//! Random loads of all kinds, as scenario text.

use linkage::case::Case;
use linkage::mechanism::LinkId;
use std::fmt::Write;

use super::sketch::RandomSource;

/// Natural magnitudes of a mechanism; a random load is at most twice as large.
#[derive(Clone, Copy, Debug)]
pub struct Sizes {
    /// N
    pub force: f64,
    /// m
    pub length: f64,
    /// m/s
    pub speed: f64,
}

/// `count` loads of random kinds.
pub fn loads(random: &mut RandomSource, case: &Case, count: usize, sizes: Sizes) -> String {
    let Sizes { force, length, speed } = sizes;
    let links = case.mechanism.links();
    let mut text = String::new();
    for _ in 0..count {
        let moving = LinkId(1 + random.index(links.len() - 1));
        let other = LinkId((moving.index() + 1 + random.index(links.len() - 1)) % links.len());
        let (link, second) = (&links[moving], &links[other]);
        let pair = format!("links = [{:?}, {:?}]", link.name, second.name);
        let point = &link.points[random.index(link.points.len())].name;
        let far = second.points.iter().find(|far| far.name != *point);
        let size = force * random.number(0.2, 2.0);
        let own = match (random.index(10), far) {
            (0, _) if case.mechanism.can_turn(moving) => {
                format!("type = \"resistance\"\nlink = {:?}\nmoment_N_m = {:?}", link.name, size * length)
            }
            (0 | 1, _) => {
                let acts = if case.mechanism.can_turn(moving) { random.index(3) } else { 0 };
                let acts = ["always", "clockwise", "counter-clockwise"][acts];
                let moment = table(random, &["moment_N_m"], force * length);
                format!("type = \"moment\"\nlink = {:?}\nacts = {acts:?}\n{moment}", link.name)
            }
            (2, _) => {
                let frame = if random.yes() { "link" } else { "world" };
                let table = table(random, &["x_N", "y_N"], force);
                format!("type = \"force\"\nlink = {:?}\npoint = {point:?}\nframe = {frame:?}\n{table}", link.name)
            }
            (3, _) => {
                let hinged = case
                    .mechanism
                    .joints()
                    .iter()
                    .any(|joint| joint.on(LinkId(0)).is_some() && joint.on(moving).is_some());
                let sort = if hinged {
                    format!("type = \"force\"\nx_N = {:?}\ny_N = {:?}", 0.06 * force, -0.4 * force)
                } else {
                    format!("type = \"resisting_force\"\nforce_N = {size:?}")
                };
                format!("{sort}\nlink = {:?}\npoint = {point:?}", link.name)
            }
            (4, Some(far)) => format!(
                "type = \"spring\"\n{pair}\npoints = [{point:?}, {:?}]\nstiffness_N_m = {:?}\nfree_length_m = {:?}",
                far.name,
                size / length,
                0.4 * length
            ),
            (5, Some(far)) => format!(
                "type = \"damper\"\n{pair}\npoints = [{point:?}, {:?}]\ndamping_N_s_m = {:?}",
                far.name,
                size / speed
            ),
            (6, _) => format!(
                "type = \"torsion_spring\"\n{pair}\nstiffness_N_m_rad = {:?}\nfree_angle_deg = 20",
                size * length
            ),
            (7, _) => format!("type = \"moment\"\nlink = {:?}\nmoment_N_m = {:?}", link.name, -size * length),
            (8, _) => {
                let frame = if random.yes() { "link" } else { "world" };
                let [x, y] = [(); 2].map(|()| force * random.number(-1.0, 1.0));
                format!(
                    "type = \"force\"\nlink = {:?}\npoint = {point:?}\nframe = {frame:?}\nx_N = {x:?}\ny_N = {y:?}",
                    link.name
                )
            }
            _ => format!("type = \"torsion_damper\"\n{pair}\ndamping_N_m_s = {:?}", size * length * length / speed),
        };
        writeln!(text, "[[loads]]\n{own}").unwrap();
    }
    text
}

/// A load table over two revolutions of the crank, with values up to `size`.
fn table(random: &mut RandomSource, names: &[&str], size: f64) -> String {
    let row = |random: &mut RandomSource, k: usize| {
        let mut row = format!("crank_deg = {:?}", -400.0 + 110.0 * k as f64 + random.number(0.0, 100.0));
        for name in names {
            write!(row, ", {name} = {:?}", size * random.number(-1.0, 1.0)).unwrap();
        }
        format!("{{ {row} }}")
    };
    let rows: Vec<String> = (0..6).map(|k| row(random, k)).collect();
    let interpolation = if random.yes() { "smooth" } else { "linear" };
    format!("turns = 2\ninterpolation = {interpolation:?}\ntable = [{}]", rows.join(", "))
}
