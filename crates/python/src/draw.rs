//! Pictures as objects of Python, and the moving picture of a notebook.

use std::sync::Arc;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use linkproof::parts::{Error, Medium, PictureOptions, When};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::errors::{OrRaised, argument, within};
use crate::scenario_class::Scenario;
use crate::task::released;
use crate::{html, sentences};

/// Width (pixels) and number of frames of the moving picture in a notebook.
const WIDTH: u32 = 560;
const FRAMES: usize = 36;

/// A medium and the options of a picture.
pub(crate) struct Wish {
    medium: Medium,
    options: PictureOptions,
}

impl Wish {
    /// Reads the keywords of `Scenario.draw`.
    pub(crate) fn of_python(py: Python<'_>, medium: &str, given: Option<Bound<'_, PyDict>>) -> PyResult<Wish> {
        let refused = |message: String| argument("medium", message, sentences::GIVE_A_MEDIUM);
        let medium = Medium::of(format!("picture.{medium}")).map_err(refused).or_raised(py)?;
        let mut options = PictureOptions::default();
        for (key, value) in given.into_iter().flatten() {
            let key: String = key.extract()?;
            match key.as_str() {
                // `None` stands for the default.
                "width" | "frames" | "seconds" if value.is_none() => {}
                "input" | "time" if options.at.is_some() => {
                    let error = argument(&key, sentences::INSTANTS_ARE_INPUTS_OR_TIMES, sentences::GIVE_INPUT_OR_TIME);
                    return Err(error).or_raised(py);
                }
                "input" => options.at = Some(When::Crank(value.extract()?)),
                "time" => options.at = Some(When::Time(value.extract()?)),
                "each_mode" => options.each_mode = value.extract()?,
                "loads" => options.loads = value.extract()?,
                "dimensions" => options.dimensions = value.extract()?,
                "all_traces" => options.all_traces = value.extract()?,
                "traces" => options.traces = value.extract()?,
                "positions" => options.positions = value.extract()?,
                "enlarged" => options.enlarged = value.extract()?,
                "groups" => options.groups = value.extract()?,
                "width" => options.width = Some(within(&key, &value, [100, 4000])?),
                "frames" => options.frames = Some(within::<i64>(&key, &value, [2, 720])? as usize),
                "seconds" => options.seconds = Some(within(&key, &value, [1e-3, 3600.0])?),
                _ => {
                    let message = sentences::there_is_no_option(&key);
                    return Err(argument(&key, message, sentences::OPTIONS_OF_PICTURES)).or_raised(py);
                }
            }
        }
        Ok(Wish { medium, options })
    }

    /// Draws the picture.
    pub(crate) fn draw(&self, scenario: &Arc<linkproof::Scenario>) -> Result<Picture, Error> {
        let bytes = linkproof::draw((**scenario).clone(), &self.options, self.medium)?;
        Ok(Picture { medium: self.medium, bytes, name: scenario.name.clone() })
    }
}

/// The moving picture of a mechanism, as HTML without references to other files.
pub(crate) fn moving(scenario: &Arc<linkproof::Scenario>) -> Result<String, Error> {
    let options = PictureOptions { width: Some(WIDTH), frames: Some(FRAMES), ..PictureOptions::default() };
    Wish { medium: Medium::WebP, options }.draw(scenario).map(|picture| picture.html())
}

/// A picture, as the bytes of a file. A notebook shows it.
#[pyclass(module = "linkproof", frozen)]
pub(crate) struct Picture {
    medium: Medium,
    bytes: Vec<u8>,
    name: String,
}

impl Picture {
    /// A drawing as SVG.
    pub(crate) fn of_svg(svg: String, name: &str) -> Picture {
        Picture { medium: Medium::Svg, bytes: svg.into_bytes(), name: name.into() }
    }

    pub(crate) fn html(&self) -> String {
        let (kind, name) = (self.kind(), html::escaped(&self.name));
        format!("<img alt=\"{name}\" src=\"data:{kind};base64,{}\"/>", STANDARD.encode(&self.bytes))
    }
}

#[pymethods]
impl Picture {
    /// The bytes of the file.
    #[getter]
    fn data<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.bytes)
    }

    /// The media type: `image/svg+xml`, `application/pdf`, `image/vnd.dxf`, `image/png`, `image/gif` or `image/webp`.
    #[getter]
    fn kind(&self) -> &'static str {
        match self.medium {
            Medium::Svg => "image/svg+xml",
            Medium::Pdf => "application/pdf",
            Medium::Dxf => "image/vnd.dxf",
            Medium::Png => "image/png",
            Medium::Gif => "image/gif",
            Medium::WebP => "image/webp",
        }
    }

    fn __repr__(&self) -> String {
        sentences::a_picture_of(&self.name, &self.kind(), &self.bytes.len())
    }

    fn _repr_html_(&self) -> String {
        match self.medium {
            Medium::Pdf | Medium::Dxf => html::paragraph(&self.__repr__()),
            Medium::Svg | Medium::Png | Medium::Gif | Medium::WebP => self.html(),
        }
    }
}

#[pymethods]
impl Scenario {
    /// Draw the mechanism.
    ///
    /// `medium`: "svg", "pdf", "png" or "dxf" for a still picture, "gif" or "webp" for a moving picture.
    /// `input`: crank angle in rad (or joint angle in rad, slide in m) of the picture.
    /// `time`: time of the picture in s.
    /// `each_mode`, `loads`, `dimensions`, `all_traces`: whether to draw all assembly modes, the loads, the dimensions,
    /// or the paths of all points.
    /// `groups`: whether to draw the driving links and the groups separately.
    /// `traces`: names of points whose paths are drawn.
    /// `enlarged`: names of points whose paths are also drawn enlarged.
    /// `positions`: number of positions.
    /// `width`: width of a bitmap in pixels.
    /// `frames`: number of frames.
    /// `seconds`: duration of a moving picture in s.
    #[pyo3(signature = (medium="svg", **options))]
    fn draw(&self, py: Python<'_>, medium: &str, options: Option<Bound<'_, PyDict>>) -> PyResult<Picture> {
        let wish = Wish::of_python(py, medium, options)?;
        let inner = self.inner.clone();
        released(py, move || wish.draw(&inner))
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        let inner = self.inner.clone();
        let picture = released(py, move || moving(&inner))?;
        Ok(html::paragraph(&self.inner.title) + &picture)
    }
}
