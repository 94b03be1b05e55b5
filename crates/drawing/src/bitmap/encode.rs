//! Bitmaps as files.

use super::Bitmap;
use crate::sentences;
use linkage::error::{Error, ErrorKind, Result};

/// Speed of the palette search: 1 is best, 30 fastest.
const PALETTE: i32 = 10;

fn unwritten(what: &str, error: &dyn std::fmt::Display) -> Error {
    Error::new(ErrorKind::Io, sentences::could_not_be_made(&what, &error))
}

/// A PNG.
///
/// # Errors
/// [`ErrorKind::Io`] if the picture cannot be encoded.
pub fn to_png(bitmap: &Bitmap) -> Result<Vec<u8>> {
    let size = tiny_skia::IntSize::from_wh(bitmap.width, bitmap.height);
    let pixmap = size.and_then(|size| tiny_skia::Pixmap::from_vec(bitmap.rgba.clone(), size));
    let pixmap = pixmap.ok_or_else(|| unwritten("the PNG", &sentences::IT_HAS_NO_PIXELS))?;
    pixmap.encode_png().map_err(|error| unwritten("the PNG", &error))
}

/// An animated GIF that repeats forever. `hundredths` is the duration of a frame in hundredths of a second.
/// All frames have the same size.
///
/// # Errors
/// [`ErrorKind::Input`] for frames of more than 65535 pixels in width or height.
/// [`ErrorKind::Io`] if the picture cannot be encoded.
pub fn to_gif(frames: &[Bitmap], hundredths: u16) -> Result<Vec<u8>> {
    let Some(first) = frames.first() else { return Ok(Vec::new()) };
    let (Ok(width), Ok(height)) = (u16::try_from(first.width), u16::try_from(first.height)) else {
        let message = sentences::a_gif_has_at_most_pixels(&first.width);
        return Err(Error::new(ErrorKind::Input, message).help(sentences::GIVE_A_SMALLER_WIDTH));
    };
    let failed = |error: gif::EncodingError| unwritten("the GIF", &error);
    let mut bytes = Vec::new();
    let mut encoder = gif::Encoder::new(&mut bytes, width, height, &[]).map_err(failed)?;
    encoder.set_repeat(gif::Repeat::Infinite).map_err(failed)?;
    for frame in frames {
        let mut frame = gif::Frame::from_rgba_speed(width, height, &mut frame.rgba.clone(), PALETTE);
        frame.delay = hundredths;
        encoder.write_frame(&frame).map_err(failed)?;
    }
    drop(encoder);
    Ok(bytes)
}

/// A lossless animated WebP that repeats forever; every frame lasts `milliseconds`. All frames have the same size.
///
/// # Errors
/// [`ErrorKind::Io`] if the picture cannot be encoded.
pub fn to_webp(frames: &[Bitmap], milliseconds: u32) -> Result<Vec<u8>> {
    let Some(first) = frames.first() else { return Ok(Vec::new()) };
    let three = |number: u32| number.to_le_bytes()[..3].to_vec();
    let size = [three(first.width - 1), three(first.height - 1)].concat();
    // No available crate writes the container of an animated WebP, so this function writes the container's chunks.
    // The flags mark the file as animated. The chunk after the flags contains the background and the endless loop.
    let mut body = chunk(*b"VP8X", &[&[0b0000_0010, 0, 0, 0], &size[..]].concat());
    body.extend(chunk(*b"ANIM", &[255, 255, 255, 255, 0, 0]));
    for frame in frames {
        let mut still = Vec::new();
        image_webp::WebPEncoder::new(&mut still)
            .encode(&frame.rgba, frame.width, frame.height, image_webp::ColorType::Rgba8)
            .map_err(|error| unwritten("the WebP", &error))?;
        // The encoded still picture consists of a header of twelve bytes and a single chunk. Only the chunk is copied.
        // Each frame replaces the previous frame.
        let place = [vec![0; 6], size.clone(), three(milliseconds), vec![0b0000_0010]].concat();
        body.extend(chunk(*b"ANMF", &[&place[..], &still[12..]].concat()));
    }
    let length = u32::try_from(body.len() + 4).map_err(|error| unwritten("the WebP", &error))?;
    Ok([&b"RIFF"[..], &length.to_le_bytes(), b"WEBP", &body].concat())
}

/// A chunk of a RIFF file: its name, its length and its content, padded to an even number of bytes.
fn chunk(name: [u8; 4], content: &[u8]) -> Vec<u8> {
    let length = (content.len() as u32).to_le_bytes();
    let pad: &[u8] = if content.len().is_multiple_of(2) { &[] } else { &[0] };
    [&name[..], &length, content, pad].concat()
}
