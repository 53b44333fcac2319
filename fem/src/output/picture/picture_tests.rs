use super::*;
use crate::Part;

/// A sheet of `n` × `n` quads; `at` gives the position of a node from two shares.
fn sheet(n: usize, at: impl Fn(f64, f64) -> [f64; 3]) -> Mesh {
    let share = |i: usize| i as f64 / n as f64;
    let points = (0..=n).flat_map(|i| (0..=n).map(move |j| (i, j))).map(|(i, j)| at(share(i), share(j))).collect();
    let node = |i: usize, j: usize| (i * (n + 1) + j) as u32;
    let quad = |i: usize, j: usize| [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
    let quads = (0..n).flat_map(|i| (0..n).map(move |j| (i, j))).map(|(i, j)| quad(i, j)).collect();
    Mesh { points, parts: vec![Part { quads, ..Part::default() }], ..Mesh::default() }
}

fn bare(view: Viewpoint) -> PictureLook {
    PictureLook { view, width: 400, height: 300, marks: false, ..PictureLook::default() }
}

fn pixel(image: &Image, x: usize, y: usize) -> [u8; 3] {
    let at = 3 * (y * image.width + x);
    [image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]]
}

fn inked(image: &Image) -> usize {
    image.rgb.chunks(3).filter(|p| *p != [255; 3]).count()
}

#[test]
fn a_square_seen_from_the_front_covers_its_pixels_in_the_colour_of_its_value() {
    let mesh = sheet(1, |a, b| [a - 0.5, b - 0.5, 0.0]);
    let look = PictureLook { limits: Some((0.0, 10.0)), ..bare(Viewpoint::Side) };
    let image = render(&mesh, &mesh.points, &[5.0], &look).unwrap();
    // 300 pixels less two margins of 12 show 1 m, so the square has 276 pixels a side.
    assert_eq!(inked(&image), 276 * 276);
    let light = 0.7 + 0.3 * 0.8;
    assert_eq!(pixel(&image, 200, 150), viridis(0.5).map(|c| (c * light * 255.0).round() as u8));
    assert_eq!(pixel(&image, 200 - 140, 150), [255; 3]);
}

#[test]
fn the_nearer_of_two_sheets_is_seen_whichever_is_drawn_first() {
    for (first, second) in [(0.1, -0.1), (-0.1, 0.1)] {
        let mut mesh = sheet(1, |a, b| [a, b, first]);
        mesh.points.extend(sheet(1, |a, b| [a, b, second]).points);
        mesh.parts[0].quads.push([4, 5, 6, 7].map(|i| i as u32));
        mesh.parts[0].quads[1] = [4, 6, 7, 5];
        let look = PictureLook { limits: Some((0.0, 1.0)), ..bare(Viewpoint::Side) };
        let image = render(&mesh, &mesh.points, &[0.0, 1.0], &look).unwrap();
        let near = if first > second { 0.0 } else { 1.0 };
        let light = 0.7 + 0.3 * 0.8;
        assert_eq!(pixel(&image, 200, 150), viridis(near).map(|c| (c * light * 255.0).round() as u8));
    }
}

#[test]
fn a_sphere_has_a_round_outline_from_every_side() {
    let tau = std::f64::consts::TAU;
    let ball = |a: f64, b: f64| {
        let (latitude, longitude) = ((a - 0.5) * tau / 2.0, b * tau);
        [latitude.cos() * longitude.cos(), latitude.sin(), latitude.cos() * longitude.sin()]
    };
    let mesh = sheet(96, ball);
    for view in [Viewpoint::Side, Viewpoint::Top, Viewpoint::End] {
        let image = render(&mesh, &mesh.points, &[], &bare(view)).unwrap();
        let wanted = std::f64::consts::PI * 138.0 * 138.0;
        // Pixels on the rim count fully: half a pixel of radius at most.
        let error = inked(&image) as f64 / wanted - 1.0;
        assert!(error.abs() < 1.0 / 138.0, "{view:?} {error}");
    }
}

#[test]
fn axes_of_every_view_are_right_handed_and_of_unit_length() {
    for view in [Viewpoint::Side, Viewpoint::Top, Viewpoint::End, Viewpoint::Isometric, Viewpoint::IsometricZUp] {
        let [right, up, out] = view.axes();
        let cross = [
            right[1] * up[2] - right[2] * up[1],
            right[2] * up[0] - right[0] * up[2],
            right[0] * up[1] - right[1] * up[0],
        ];
        assert!((0..3).all(|k| (cross[k] - out[k]).abs() < 1e-15), "{view:?}");
        assert!((dot(right, right) - 1.0).abs() < 1e-15 && (dot(up, up) - 1.0).abs() < 1e-15);
    }
}

/// The scale says how long something is: a sheet of 0.1 m has five times the length of a scale of 20 mm.
#[test]
fn the_scale_has_the_length_that_it_says() {
    let mesh = sheet(1, |a, b| [0.1 * a, 0.01 * b, 0.0]);
    let look = PictureLook { marks: true, ..bare(Viewpoint::Side) };
    let image = render(&mesh, &mesh.points, &[], &look).unwrap();
    let ink = |x: &usize, y: usize| pixel(&image, *x, y)[0] < 100;
    // Letters are a fortieth of the height and at least 10 pixels; the line is 1.6 of them above the edge, right of the axes.
    let scale = (60..image.width).filter(|x| ink(x, 284)).count();
    let sheet = (0..image.width).filter(|x| pixel(&image, *x, 125) != [255; 3]).count();
    assert!((sheet as f64 / scale as f64 - 5.0).abs() < 0.2, "{sheet} pixels, scale {scale}");
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    let mesh = sheet(2, |a, b| [a, b, 0.0]);
    let mut points = mesh.points.clone();
    let say = |points: &[[f64; 3]], values: &[f64], look: &PictureLook| {
        render(&mesh, points, values, look).unwrap_err().to_string()
    };
    let look = bare(Viewpoint::Top);
    assert!(say(&points[1..], &[], &look).contains("8 positions"));
    assert!(say(&points, &[1.0], &look).contains("1 values"));
    assert!(say(&points, &[1.0, 2.0, f64::NAN, 0.0], &look).contains("element 3 is NaN"));
    assert!(say(&points, &[], &PictureLook { width: 5000, ..look.clone() }).contains("128 to 4096"));
    assert!(say(&points, &[], &PictureLook { limits: Some((1.0, 1.0)), ..look.clone() }).contains("limits"));
    points[4][2] = f64::INFINITY;
    assert!(say(&points, &[], &look).contains("node 5"));
    assert_eq!(inked(&render(&Mesh::default(), &[], &[], &look).unwrap()), 0);
}

#[test]
fn a_written_png_is_read_back_pixel_by_pixel() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mesh.png");
    let mesh = sheet(8, |a, b| [a, 0.3 * (3.0 * a).sin() * b, b]);
    let values: Vec<f64> = (0..64).map(f64::from).collect();
    let image = render(&mesh, &mesh.points, &values, &PictureLook::default()).unwrap();
    std::fs::write(&path, png_bytes(&image)).unwrap();
    let file = std::io::BufReader::new(std::fs::File::open(path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut rgb = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut rgb).unwrap();
    assert_eq!((info.width as usize, info.height as usize), (image.width, image.height));
    assert!(rgb == image.rgb);
}
