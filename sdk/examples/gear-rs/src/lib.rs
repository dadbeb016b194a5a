// SPDX-FileCopyrightText: The Impinge authors
// SPDX-License-Identifier: MIT

//! The flanks of an involute gear: a plugin for Impinge in Rust, without dependencies.
//!
//!     cargo build --release && cp target/release/libgear_rs.so gear_rs.so
//!     impinge check gear_rs --plugin-path .
//!
//! A flank unrolls from the base circle: with phi = angle + s u, s = 1 or -1 for either side of a
//! tooth, (base (cos phi + s u sin phi), base (sin phi - s u cos phi), v). Each flank is a piece.

mod abi;

use abi::*;
use std::ffi::{c_void, CStr};
use std::os::raw::c_char;

/// A text of C.
macro_rules! c {
    ($text:literal) => {
        concat!($text, "\0").as_ptr() as *const c_char
    };
}

/* --- Parameters ------------------------------------------------------------------------------- */

const TEETH: usize = 0;
const BASE: usize = 1;
const ROLL: usize = 2;
const WIDTH: usize = 3;

const fn row(
    name: *const c_char, unit: *const c_char, doc: *const c_char, default_value: *const c_char,
    kind: u32, flags: u32, min: f64, max: f64,
) -> Parameter {
    Parameter { name, unit, doc, default_value, kind, flags, rank: 0, extent: [0; 3], min, max }
}

static PARAMETERS: Shared<[Parameter; 4]> = Shared([
    row(
        c!("teeth"), c!("1"), c!("how many teeth it has"), c!("12"), KIND_INTEGER, 0,
        3.0, 1000.0,
    ),
    row(
        c!("base"), c!("length"), c!("radius of the base circle"), c!("1"), KIND_NUMBER, MIN_OPEN,
        0.0, 1e6,
    ),
    row(
        c!("roll"), c!("rad"), c!("how far a flank unrolls"), c!("0.6"), KIND_NUMBER, MIN_OPEN,
        0.0, 3.0,
    ),
    row(
        c!("width"), c!("length"), c!("along the z axis"), c!("0.5"), KIND_NUMBER, MIN_OPEN,
        0.0, 1e6,
    ),
]);

/* --- Instances -------------------------------------------------------------------------------- */

struct Flank {
    base: f64,
    angle: f64,
    sign: f64,
    roll: f64,
    width: f64,
}

struct Gear {
    flanks: Vec<Flank>,
}

/// The half tooth at the base circle, in parts of the pitch.
const HALF_TOOTH: f64 = 0.3;

unsafe extern "C" fn create(
    values: *const Value, own: *mut *mut c_void, why: *mut CreateError,
) -> Status {
    let value = |k: usize| *(*values.add(k)).number;
    let (teeth, base, roll, width) = (value(TEETH), value(BASE), value(ROLL), value(WIDTH));
    let pitch = 2.0 * std::f64::consts::PI / teeth;
    if roll - roll.atan() >= HALF_TOOTH * pitch {
        let text = b"the flanks of a tooth meet before that; must be smaller for so many teeth\0";
        (*why).parameter = ROLL as i32;
        (&mut (*why).text)[..text.len()].copy_from_slice(text);
        return PARAMETER;
    }
    let flank = |k: usize, sign: f64| Flank {
        base, sign, roll, width,
        angle: pitch * (k as f64 - sign * HALF_TOOTH),
    };
    let flanks = (0..teeth as usize).flat_map(|k| [flank(k, 1.0), flank(k, -1.0)]).collect();
    *own = Box::into_raw(Box::new(Gear { flanks })) as *mut c_void;
    OK
}

unsafe extern "C" fn destroy(own: *mut c_void) {
    drop(Box::from_raw(own as *mut Gear));
}

unsafe extern "C" fn piece_count(own: *const c_void) -> usize {
    (*(own as *const Gear)).flanks.len()
}

unsafe extern "C" fn piece(own: *const c_void, k: usize) -> *const c_void {
    let gear = &*(own as *const Gear);
    &gear.flanks[k] as *const Flank as *const c_void
}

/* --- One flank -------------------------------------------------------------------------------- */

unsafe extern "C" fn domain(own: *const c_void, lo: *mut f64, hi: *mut f64) {
    let flank = &*(own as *const Flank);
    let ends = [
        (0.0, flank.roll),
        (-0.5 * flank.width, 0.5 * flank.width),
        (f64::NEG_INFINITY, f64::INFINITY),
    ];
    for (j, (from, to)) in ends.iter().enumerate() {
        *lo.add(j) = *from;
        *hi.add(j) = *to;
    }
}

unsafe extern "C" fn formula(own: *const c_void, u: Model, v: Model, _t: Model, out: *mut Model) {
    let flank = &*(own as *const Flank);
    let way = u * flank.sign;
    let (sine, cosine) = sin_cos(way + flank.angle);
    *out.add(0) = (cosine + way * sine) * flank.base;
    *out.add(1) = (sine - way * cosine) * flank.base;
    *out.add(2) = v;
}

unsafe extern "C" fn eval(
    own: *const c_void, n: usize, p: *const f64, x: *mut f64, error: *mut f64,
) -> Status {
    impinge_surface_eval(formula, own, n, p, x, error)
}

unsafe extern "C" fn rate(
    own: *const c_void, region: *const Region, rates: *mut RateMatrix,
) -> Status {
    impinge_surface_rate(formula, own, region, rates)
}

unsafe extern "C" fn include(
    own: *const c_void, region: *const Region, model: *mut Model,
) -> Status {
    impinge_surface_include(formula, own, region, model)
}

/* --- The plugin ------------------------------------------------------------------------------- */

static TYPE: Shared<SurfaceType> = Shared(SurfaceType {
    struct_size: std::mem::size_of::<SurfaceType>() as u32,
    parameter_count: 4,
    parameter_size: std::mem::size_of::<Parameter>() as u32,
    flags: 0,
    name: c!("gear-rs"),
    summary: c!("flanks of an involute gear"),
    equation: c!(
        "phi = angle + s u: (base (cos phi + s u sin phi), base (sin phi - s u cos phi), v)"
    ),
    source: std::ptr::null(),
    example: c!("gear-rs teeth=20 roll=0.5"),
    parameters: &PARAMETERS.0 as *const Parameter,
    create, destroy, domain, eval, rate, include,
    net: None,
    piece_count, piece,
    distance: None,
    symmetry: None,
});

static TYPES: Shared<[*const SurfaceType; 1]> = Shared([&TYPE.0]);

static FACTORY: Shared<SurfaceFactory> = Shared(SurfaceFactory {
    struct_size: std::mem::size_of::<SurfaceFactory>() as u32,
    count: 1,
    types: &TYPES.0 as *const *const SurfaceType,
});

unsafe extern "C" fn get_factory(id: *const c_char) -> *const c_void {
    if CStr::from_ptr(id).to_bytes() == b"impinge.surface/1" {
        return &FACTORY.0 as *const SurfaceFactory as *const c_void;
    }
    std::ptr::null()
}

#[no_mangle]
#[allow(non_upper_case_globals)]
pub static impinge_plugin: Shared<Plugin> = Shared(Plugin {
    magic: 0x31706D49,
    struct_size: std::mem::size_of::<Plugin>() as u32,
    abi_major: 1,
    abi_minor: 0,
    name: c!("gear-rs"),
    version: c!("0.1.0"),
    license: c!("MIT"),
    author: c!("The Impinge authors"),
    get_factory,
});

/// The ELF note that a host reads before it runs any code: sizes of name and descriptor, type 1,
/// "Impinge", then ABI 1.0, the plugin's name and its version, each text with a NUL.
#[repr(C, align(4))]
struct Note {
    name_size: u32,
    descriptor_size: u32,
    kind: u32,
    owner: [u8; 8],
    abi: [u32; 2],
    texts: [u8; 14],
}

#[used]
#[link_section = ".note.impinge"]
static NOTE: Note = Note {
    name_size: 8,
    descriptor_size: 8 + 14,
    kind: 1,
    owner: *b"Impinge\0",
    abi: [1, 0],
    texts: *b"gear-rs\x000.1.0\0",
};
