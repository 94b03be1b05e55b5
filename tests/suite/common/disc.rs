//! A disc on a motor, whose run-up has a closed form.

/// The disc with a free crank; `rest` contains the other keys of `[drive]`, the motor, the start and the grid.
pub fn disc(rest: &str) -> String {
    format!("format = 1\nname = \"disc\"\ntitle = \"Disc run up by a linear motor\"\n{PARTS}{rest}")
}

const PARTS: &str = r#"
[ground.points]
O = { x_mm = 0, y_mm = 0 }

[links.disc]
mass_kg = 4
mass_centre = { x_mm = 0, y_mm = 0 }
inertia_kg_m2 = 0.05
[links.disc.points]
O = { x_mm = 0, y_mm = 0 }
P = { x_mm = 100, y_mm = 0 }

[[joints]]
name = "O"
type = "revolute"
links = ["ground", "disc"]

[drive]
joint = "O"
motion = "free"
speed_rad_s = 20
"#;
