//! Scenario files for linkages that were found in closed form.

use crate::sentences;
use std::fmt::Write;

use super::crank_rocker::CrankRocker;
use super::precision::{CrankTravel, PrecisionFourBar};
use super::slider_crank::SliderCrank;
use linkage::math::{Complex, KeepNan};

/// Contents of a scenario, except the dimensions.
#[derive(Clone, Debug, PartialEq)]
pub struct DraftContents {
    /// Name of the scenario, with only such characters as file names permit.
    pub name: String,
    /// Title for the reader, in one line.
    pub title: String,
    /// Comment at the top of the file; its lines have no leading `#`.
    pub comment: String,
    /// Speed of the crank (rad/s), not zero, counter-clockwise positive.
    pub speed: f64,
    /// Mass of the links per metre of their length (kg/m). The links are uniform slender bars.
    pub bar: f64,
}

impl DraftContents {
    fn head(&self) -> String {
        let mut text: String = self.comment.lines().map(|line| format!("# {line}\n")).collect();
        let _ = writeln!(text, "format = 1\nname = {:?}\ntitle = {:?}\n", self.name, self.title);
        text
    }

    /// Scenario text of a link that is one bar. The bar lies along the link's x axis, with its first point at the
    /// origin.
    fn bar(&self, name: &str, [first, second]: [&str; 2], length: f64) -> String {
        self.bars(name, &[(first, Complex::default()), (second, Complex::new(length, 0.0))])
    }

    /// Scenario text of a link that consists of slender bars. The bars join the first of `points` (m, in the link's
    /// frame) to each of the other points.
    fn bars(&self, name: &str, points: &[(&str, Complex)]) -> String {
        let first = points[0].1;
        let arms = || points[1..].iter().map(|(_, point)| point - first);
        let mass: f64 = arms().map(|arm| self.bar * arm.norm()).sum();
        // Moments about the first point: m l / 2, and m l^2 / 3.
        let moment: Complex = arms().map(|arm| arm * (self.bar * arm.norm() / 2.0)).sum();
        let centre = moment / mass;
        let inertia = arms().map(|arm| self.bar * arm.norm().powi(3) / 3.0).sum::<f64>() - mass * centre.norm_sqr();
        let mut text = format!(
            "[links.{name}]\nmass_kg = {mass:?}\ninertia_kg_m2 = {inertia:?}\nmass_centre = {}\n[links.{name}.points]\n",
            place(first + centre)
        );
        points.iter().for_each(|(point, at)| text += &format!("{point} = {}\n", place(*at)));
        text + "\n"
    }

    fn tail(&self, group: &str, mode: &str, course: &Course) -> String {
        let Course { from, to, step } = course;
        format!(
            "[drive]\njoint = \"O\"\nspeed_rad_s = {:?}\n\n[gravity]\nx_m_s2 = 0\ny_m_s2 = -9.81\n\n[start]\ncrank_deg = {from}\n\
             [[start.groups]]\nlinks = [{group}]\nmode = \"{mode}\"\n\n[grid]\nfrom_deg = {from}\nto_deg = {to}\nstep_deg = {step}\n",
            self.speed
        )
    }
}

/// Crank angles of a scenario's grid (deg). `from` is the crank angle of the start pose.
struct Course {
    from: f64,
    to: f64,
    step: f64,
}

impl Course {
    /// Largest step (deg).
    const STEP: f64 = 1.0;

    /// A full turn from crank angle zero. The sign of `speed` gives the sense.
    fn turn(speed: f64) -> Self {
        let sense = if speed < 0.0 { -1.0 } else { 1.0 };
        Course { from: 0.0, to: 360.0 * sense, step: Course::STEP * sense }
    }

    /// Crank angles from one angle to another (deg).
    fn between(from: f64, to: f64) -> Self {
        let steps = ((to - from).abs() / Course::STEP).ceil().larger(20.0);
        Course { from, to, step: (to - from) / steps }
    }
}

/// Scenario text of a point (m).
fn place(at: Complex) -> String {
    format!("{{ x_m = {:?}, y_m = {:?} }}", at.re + 0.0, at.im + 0.0)
}

/// Scenario text of pins. Each pin joins two links.
fn pins(all: &[(&str, [&str; 2])]) -> String {
    let pin = |(name, [first, second]): &(&str, [&str; 2])| {
        sentences::joints_name_type_revolute_links(&name, &first, &second)
    };
    all.iter().map(pin).collect()
}

/// Pins of a four-bar, each with its two links.
const FOUR_BAR: [(&str, [&str; 2]); 4] = [
    ("O", ["ground", "crank"]),
    ("A", ["crank", "coupler"]),
    ("B", ["coupler", "rocker"]),
    ("C", ["ground", "rocker"]),
];

/// Links of a four-bar's dyad.
const FOUR_BAR_GROUP: &str = "\"coupler\", \"rocker\"";

/// Scenario text of the pivots of crank and rocker (m).
fn ground([o, c]: [Complex; 2]) -> String {
    format!("[ground.points]\nO = {}\nC = {}\n\n", place(o), place(c))
}

impl CrankRocker {
    /// The scenario file.
    pub fn scenario(&self, sheet: &DraftContents) -> String {
        let pivots = [self.wish.crank_pivot, self.wish.rocker_pivot].map(|pivot| Complex::new(pivot.x, pivot.y));
        let mut text = sheet.head() + &ground(pivots);
        text += &sheet.bar("crank", ["O", "A"], self.crank);
        text += &sheet.bar("coupler", ["A", "B"], self.coupler);
        text += &sheet.bar("rocker", ["C", "B"], self.wish.rocker);
        text += &pins(&FOUR_BAR);
        text + &sheet.tail(FOUR_BAR_GROUP, self.mode.name(), &Course::turn(sheet.speed))
    }
}

impl PrecisionFourBar {
    /// The scenario file.
    /// The order of the positions determines the crank's sense of rotation. Only the magnitude of the speed is used.
    pub fn scenario(&self, sheet: &DraftContents) -> String {
        let [crank, coupler, rocker] = self.frames;
        let ([o, c], [a, b]) = (self.pivots, self.pins);
        let point = self.point.map(|point| ("P", coupler.local(point)));
        let of_coupler: Vec<(&str, Complex)> =
            [("A", coupler.local(a)), ("B", coupler.local(b))].into_iter().chain(point).collect();
        let course = self.course();
        let sheet = DraftContents { speed: sheet.speed.abs().copysign(course.step), ..sheet.clone() };
        let mut text = sheet.head() + &ground(self.pivots);
        text += &sheet.bars("crank", &[("O", crank.local(o)), ("A", crank.local(a))]);
        text += &sheet.bars("coupler", &of_coupler);
        text += &sheet.bars("rocker", &[("C", rocker.local(c)), ("B", rocker.local(b))]);
        text += &pins(&FOUR_BAR);
        text + &sheet.tail(FOUR_BAR_GROUP, self.checks.mode.name(), &course)
    }

    /// Crank angles of the scenario: a full turn from position 1, or the range between the positions.
    fn course(&self) -> Course {
        let degrees = |turn: f64| (self.frames[0].angle + turn).to_degrees();
        match self.checks.travel {
            CrankTravel::FullTurn { sense } => {
                Course { from: degrees(0.0), to: degrees(0.0) + 360.0 * sense, step: Course::STEP * sense }
            }
            CrankTravel::Between([from, to]) => Course::between(degrees(from), degrees(to)),
        }
    }
}

impl SliderCrank {
    /// The scenario file.
    pub fn scenario(&self, sheet: &DraftContents) -> String {
        let mut text = sheet.head();
        let _ = writeln!(text, "{}", sentences::ground_points_on_the_slider(&format_args!("{:?}", self.offset)));
        text += &sheet.bar("crank", ["O", "A"], self.crank);
        text += &sheet.bar("rod", ["A", "B"], self.rod);
        let mass = sheet.bar * self.crank;
        let _ = writeln!(
            text,
            "# As heavy as the crank.\n[links.slider]\nmass_kg = {mass:?}\nmass_centre = {{ x_m = 0, y_m = 0 }}\n\
             [links.slider.points]\nB = {{ x_m = 0, y_m = 0 }}\n"
        );
        text += &pins(&[("O", ["ground", "crank"]), ("A", ["crank", "rod"]), ("B", ["rod", "slider"])]);
        text += sentences::JOINTS_NAME_GUIDE_TYPE_PRISMATIC;
        text + &sheet.tail("\"rod\", \"slider\"", "ahead", &Course::turn(sheet.speed))
    }
}
