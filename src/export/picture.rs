//! Pictures inside of drawings.
//!
//! They are PNG files whose data are not compressed: cells are few, and in the page an encoder would weigh more than all
//! else that exports. Format: W3C PNG (Third Edition), RFC 1950 and 1951.

use super::Rgba;

/// Bytes that one block of data that are not compressed can hold.
const BLOCK: usize = 65_535;
/// Colours that a palette can hold.
const PALETTE: usize = 256;

/// The picture as a `data:` address of a PNG; `None` when `pixels` are not `size`.
pub(super) fn data_address(size: (usize, usize), pixels: &[Rgba]) -> Option<String> {
    Some(format!("data:image/png;base64,{}", base64(&png(size, pixels)?)))
}

/// A PNG: with a palette where there are few colours, a quarter of the bytes otherwise needed.
fn png((columns, rows): (usize, usize), pixels: &[Rgba]) -> Option<Vec<u8>> {
    let (width, height) = (u32::try_from(columns).ok()?, u32::try_from(rows).ok()?);
    if columns == 0 || pixels.len() != columns.checked_mul(rows)? {
        return None;
    }
    let mut colours = pixels.to_vec();
    colours.sort_unstable();
    colours.dedup();
    let indexed = colours.len() <= PALETTE;
    let mut data = Vec::new();
    for row in pixels.chunks(columns) {
        // No filter.
        data.push(0);
        if indexed {
            // Every colour is in the list.
            data.extend(row.iter().map(|colour| colours.binary_search(colour).unwrap_or(0) as u8));
        } else {
            data.extend_from_slice(row.as_flattened());
        }
    }
    let mut header = [width.to_be_bytes(), height.to_be_bytes()].concat();
    header.extend([8, if indexed { 3 } else { 6 }, 0, 0, 0]);
    let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
    chunk(&mut file, b"IHDR", &header);
    if indexed {
        let opaque: Vec<u8> = colours.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]).collect();
        let opacities: Vec<u8> = colours.iter().map(|colour| colour[3]).collect();
        chunk(&mut file, b"PLTE", &opaque);
        chunk(&mut file, b"tRNS", &opacities);
    }
    chunk(&mut file, b"IDAT", &stored(&data));
    chunk(&mut file, b"IEND", &[]);
    Some(file)
}

/// A chunk with its length and its check.
fn chunk(file: &mut Vec<u8>, kind: &[u8; 4], data: &[u8]) {
    file.extend((data.len() as u32).to_be_bytes());
    let start = file.len();
    file.extend_from_slice(kind);
    file.extend_from_slice(data);
    let check = crc32(&file[start..]);
    file.extend(check.to_be_bytes());
}

/// A stream in the format of zlib that holds `data` as they are.
fn stored(data: &[u8]) -> Vec<u8> {
    let mut stream = vec![0x78, 0x01];
    let last = data.len().div_ceil(BLOCK).saturating_sub(1);
    for (number, block) in data.chunks(BLOCK).enumerate() {
        let length = block.len() as u16;
        stream.push(u8::from(number == last));
        stream.extend(length.to_le_bytes());
        stream.extend((!length).to_le_bytes());
        stream.extend_from_slice(block);
    }
    let (mut a, mut b) = (1_u32, 0_u32);
    for byte in data {
        a = (a + u32::from(*byte)) % 65_521;
        b = (b + a) % 65_521;
    }
    stream.extend((b << 16 | a).to_be_bytes());
    stream
}

fn crc32(data: &[u8]) -> u32 {
    !data.iter().fold(u32::MAX, |check, byte| {
        (0..8).fold(check ^ u32::from(*byte), |check, _| {
            (check >> 1) ^ (0xedb8_8320 & (check & 1).wrapping_neg())
        })
    })
}

fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let part = |i: usize| u32::from(chunk.get(i).copied().unwrap_or(0));
        let word = part(0) << 16 | part(1) << 8 | part(2);
        for digit in 0..4 {
            let value = (word >> (18 - 6 * digit)) & 63;
            text.push(if digit > chunk.len() { '=' } else { char::from(DIGITS[value as usize]) });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_the_standard() {
        for (plain, coded) in
            [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")]
        {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }

    /// What a decoder that is not ours makes of a file; it checks every sum.
    fn decoded(file: &[u8]) -> Vec<u8> {
        let mut decoder = png::Decoder::new(std::io::Cursor::new(file));
        decoder.set_transformations(png::Transformations::EXPAND | png::Transformations::ALPHA);
        let mut reader = decoder.read_info().expect("a PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
        reader.next_frame(&mut pixels).expect("a picture");
        pixels
    }

    #[test]
    fn pictures_of_few_and_of_many_colours_are_read_back_pixel_by_pixel() {
        let few: Vec<Rgba> = (0..6_u8).map(|i| [i, 200, 7 * i, if i == 3 { 0 } else { 255 - i }]).collect();
        let many: Vec<Rgba> =
            (0..160 * 130_u32).map(|i| [(i % 251) as u8, (i / 251) as u8, (i % 7) as u8, 255]).collect();
        for (size, pixels) in [((3, 2), few), ((160, 130), many)] {
            let file = png(size, &pixels).expect("a size that fits");
            assert_eq!(decoded(&file), pixels.as_flattened());
        }
        assert_eq!(png((2, 2), &[[0; 4]]), None);
        assert_eq!(png((0, 0), &[]), None);
        assert_eq!(data_address((1, 2), &[[0; 4]]), None);
    }
}
