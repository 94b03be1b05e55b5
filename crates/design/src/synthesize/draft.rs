//! Scenario files for linkages that were found in closed form.

use crate::sentences;
use std::fmt::Write;

use super::crank_rocker::CrankRocker;
use super::slider_crank::SliderCrank;

/// Contents of a scenario besides the dimensions.
#[derive(Clone, Debug, PartialEq)]
pub struct DraftContents {
    /// Name of the scenario, usable in file names.
    pub name: String,
    /// Title for the reader, in one line.
    pub title: String,
    /// Comment at the top of the file; its lines have no leading `#`.
    pub comment: String,
    /// Speed of the crank (rad/s), not zero, counter-clockwise positive.
    pub speed: f64,
    /// Mass per metre of the links (kg/m). The links are uniform slender bars.
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
    fn bar(&self, name: &str, points: [&str; 2], length: f64) -> String {
        let mass = self.bar * length;
        format!(
            "[links.{name}]\nmass_kg = {mass:?}\ninertia_kg_m2 = {:?}\nmass_centre = {{ x_m = {:?}, y_m = 0 }}\n\
             [links.{name}.points]\n{} = {{ x_m = 0, y_m = 0 }}\n{} = {{ x_m = {length:?}, y_m = 0 }}\n\n",
            mass * length * length / 12.0,
            length / 2.0,
            points[0],
            points[1],
        )
    }

    fn tail(&self, group: &str, mode: &str) -> String {
        let (sign, end) = if self.speed < 0.0 { ("-", -360) } else { ("", 360) };
        format!(
            "[drive]\njoint = \"O\"\nspeed_rad_s = {:?}\n\n[gravity]\nx_m_s2 = 0\ny_m_s2 = -9.81\n\n[start]\ncrank_deg = 0\n\
             [[start.groups]]\nlinks = [{group}]\nmode = \"{mode}\"\n\n[grid]\nfrom_deg = 0\nto_deg = {end}\nstep_deg = {sign}1\n",
            self.speed
        )
    }
}

/// Scenario text of pins. Each pin joins two links.
fn pins(all: &[(&str, [&str; 2])]) -> String {
    let pin = |(name, [first, second]): &(&str, [&str; 2])| {
        sentences::joints_name_type_revolute_links(&name, &first, &second)
    };
    all.iter().map(pin).collect()
}

impl CrankRocker {
    /// The scenario file.
    pub fn scenario(&self, sheet: &DraftContents) -> String {
        let [o, c] = [self.wish.crank_pivot, self.wish.rocker_pivot];
        let mut text = sheet.head();
        let _ = writeln!(
            text,
            "[ground.points]\nO = {{ x_m = {:?}, y_m = {:?} }}\nC = {{ x_m = {:?}, y_m = {:?} }}\n",
            o.x, o.y, c.x, c.y
        );
        text += &sheet.bar("crank", ["O", "A"], self.crank);
        text += &sheet.bar("coupler", ["A", "B"], self.coupler);
        text += &sheet.bar("rocker", ["C", "B"], self.wish.rocker);
        let (o, a) = (("O", ["ground", "crank"]), ("A", ["crank", "coupler"]));
        text += &pins(&[o, a, ("B", ["coupler", "rocker"]), ("C", ["ground", "rocker"])]);
        text + &sheet.tail("\"coupler\", \"rocker\"", self.mode.name())
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
        text + &sheet.tail("\"rod\", \"slider\"", "ahead")
    }
}
