//! OpenEXR by the crate `exr`: the first layer, on its display window.

use std::io::Cursor;

use exr::prelude::{
    AnyChannel, AnyChannels, Encoding as Packing, FlatSamples, Image as File, Layer,
    LayerAttributes, MetaData, ReadChannels, ReadLayers, SmallVec, WritableImage, read as reader,
};
use spectra::{RgbSpace, rgb::Curve};

use super::pixels::{Encoding, Image, ImageError, check_size};

fn malformed(error: impl ToString) -> ImageError {
    ImageError::Malformed { format: "EXR", problem: error.to_string() }
}

pub(super) fn read(bytes: &[u8]) -> Result<Image, ImageError> {
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(malformed)?;
    for header in &meta.headers {
        check_size(header.layer_size.x(), header.layer_size.y())?;
        let window = header.shared_attributes.display_window.size;
        check_size(window.x(), window.y())?;
    }
    let file = reader()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(malformed)?;
    let layer = &file.layer_data;
    let channels = colour_channels(&layer.channel_data.list)?;
    let window = file.attributes.display_window;
    let size = [window.size.x(), window.size.y()];
    // The position of the layer's first pixel in the window.
    let at = layer.attributes.layer_position;
    let left = i64::from(at.x()) - i64::from(window.position.x());
    let top = i64::from(at.y()) - i64::from(window.position.y());
    let mut values = vec![0.0; size[0] * size[1] * channels.len()];
    for (number, channel) in channels.iter().enumerate() {
        let mut samples = channel.sample_data.values_as_f32();
        for y in 0..layer.size.y() as i64 {
            for x in 0..layer.size.x() as i64 {
                let value = samples.next().ok_or_else(|| malformed("samples are missing"))?;
                let (x, y) = (x + left, y + top);
                let inside = (0..size[0] as i64).contains(&x) && (0..size[1] as i64).contains(&y);
                if inside {
                    let pixel = y as usize * size[0] + x as usize;
                    values[pixel * channels.len() + number] = value;
                }
            }
        }
    }
    let mut image = Image::new(size, channels.len(), values, Encoding::Linear)?;
    if let Some(given) = file.attributes.chromaticities {
        let [red, green, blue, white] = [given.red, given.green, given.blue, given.white]
            .map(|v| [f64::from(v.x()), f64::from(v.y())]);
        let space =
            RgbSpace::from_primaries("of the file", [red, green, blue], white, Curve::Linear);
        image.space = space.map_err(malformed)?;
    }
    Ok(image)
}

type ExrChannel = AnyChannel<FlatSamples>;

/// Red, green and blue, or the only channel apart from transparency.
fn colour_channels(list: &[ExrChannel]) -> Result<Vec<&ExrChannel>, ImageError> {
    let last = |channel: &ExrChannel| {
        let name = channel.name.to_string();
        name.rsplit('.').next().unwrap_or_default().to_owned()
    };
    let find = |name: &str| list.iter().find(|channel| last(channel).eq_ignore_ascii_case(name));
    let channels = match [find("R"), find("G"), find("B")] {
        [Some(r), Some(g), Some(b)] => vec![r, g, b],
        _ => {
            let opaque = |channel: &&ExrChannel| !last(channel).eq_ignore_ascii_case("A");
            let [only] = list.iter().filter(opaque).collect::<Vec<_>>()[..] else {
                let names: Vec<String> = list.iter().map(|each| each.name.to_string()).collect();
                return Err(malformed(format!(
                    "its channels are {}; R, G and B, or one channel, are read",
                    names.join(", ")
                )));
            };
            vec![only]
        }
    };
    if channels.iter().any(|channel| channel.sampling.x() != 1 || channel.sampling.y() != 1) {
        return Err(malformed("a channel has fewer samples than there are pixels"));
    }
    Ok(channels)
}

pub(super) fn write(image: &Image) -> Result<Vec<u8>, ImageError> {
    let names: &[&str] = if image.channels == 1 { &["Y"] } else { &["R", "G", "B"] };
    let channel = |(number, name): (usize, &&str)| {
        let samples = image.linear().map(|pixel| pixel[number] as f32).collect();
        AnyChannel::new(*name, FlatSamples::F32(samples))
    };
    let channels: SmallVec<_> = names.iter().enumerate().map(channel).collect();
    let layer = Layer::new(
        (image.width, image.height),
        LayerAttributes::default(),
        Packing::SMALL_LOSSLESS,
        AnyChannels::sort(channels),
    );
    let mut bytes = Cursor::new(Vec::new());
    let file = File::from_layer(layer);
    file.write().non_parallel().to_buffered(&mut bytes).map_err(malformed)?;
    Ok(bytes.into_inner())
}
