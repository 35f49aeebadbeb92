//! Projections against points computed by hand, and near planes against what they must not cut.

use super::super::tests::{from_plus_x, v};
use super::*;
use glam::DVec4;

fn at(min: DVec3, max: DVec3) -> Aabb {
    Aabb { min, max }
}

fn orthographic_from_plus_x() -> View {
    View {
        lens: Lens::Orthographic { half_height: 3.0 },
        ..from_plus_x()
    }
}

fn project(view: &View, aspect: f64, range: DepthRange, p: DVec3) -> DVec4 {
    view.clip_from_view(aspect, range) * view.p_in_view(p).extend(1.0)
}

#[test]
fn clip_coordinates_of_points() {
    let infinite = DepthRange {
        near: 0.5,
        far: f64::INFINITY,
    };
    let finite = DepthRange {
        near: -2.0,
        far: 18.0,
    };
    // The eye is at (10, 0, 0) and sees +Y to the right. Point in the world; x, y, depth in the
    // image. Half height 0.5 per unit of depth, or 3; aspect ratio 2.
    let (p, o) = (from_plus_x(), orthographic_from_plus_x());
    let rows = [
        (p, infinite, v(9.5, 0.0, 0.0), [0.0, 0.0, 1.0]),
        (p, infinite, v(0.0, 0.0, 0.0), [0.0, 0.0, 0.05]),
        (p, infinite, v(0.0, 10.0, 5.0), [1.0, 1.0, 0.05]),
        (p, infinite, v(6.0, -2.0, -1.0), [-0.5, -0.5, 0.125]),
        (p, infinite, v(-1e9, 0.0, 0.0), [0.0, 0.0, 5e-10]),
        (o, finite, v(12.0, 0.0, 0.0), [0.0, 0.0, 1.0]),
        (o, finite, v(-8.0, 6.0, 3.0), [1.0, 1.0, 0.0]),
        (o, finite, v(2.0, -3.0, 1.5), [-0.5, 0.5, 0.5]),
    ];
    for (view, range, point, expected) in rows {
        let clip = project(&view, 2.0, range, point);
        let image = (clip.truncate() / clip.w).to_array();
        for (a, b) in image.into_iter().zip(expected) {
            assert!((a - b).abs() < 1e-14, "{point}: {image:?}");
        }
    }
    // A direction is a point at infinity: depth 0, in front.
    let away = p.clip_from_view(2.0, infinite) * DVec4::new(1.0, 0.5, -1.0, 0.0);
    assert_eq!(
        (away.x / away.w, away.y / away.w, away.z / away.w),
        (1.0, 1.0, 0.0)
    );
}

#[test]
fn planes_agree_with_clip_space() {
    let mut inside = [0; 2];
    for (which, view) in [from_plus_x(), orthographic_from_plus_x()]
        .into_iter()
        .enumerate()
    {
        let range = DepthRange {
            near: 2.0,
            far: if which == 0 { f64::INFINITY } else { 15.0 },
        };
        let planes = view.frustum_planes(1.5, range);
        for plane in planes {
            let length = plane.truncate().length();
            assert!((length - 1.0).abs() < 1e-14 || plane == DVec4::W, "{plane}");
        }
        for i in 0..11 * 11 * 11 {
            let step = |k: i32| f64::from(i / k % 11) * 3.1 - 15.3;
            let p = v(step(1), step(11), step(121));
            let clip = project(&view, 1.5, range, p);
            // In the order of the planes; the far end is depth 0.
            let by_clip = [
                clip.x >= -clip.w,
                clip.x <= clip.w,
                clip.y >= -clip.w,
                clip.y <= clip.w,
                clip.z <= clip.w,
                clip.z >= 0.0,
            ];
            let by_plane = planes.map(|plane| plane.dot(p.extend(1.0)) >= 0.0);
            assert_eq!(by_plane, by_clip, "{p}");
            inside[which] += i32::from(by_clip == [true; 6]);
        }
    }
    assert!(
        inside.iter().all(|&n| n > 20),
        "too few points inside: {inside:?}"
    );
}

#[test]
fn near_planes() {
    // The eye is at (10, 0, 0) and looks along -X; the image's corners have a slope of
    // 0.5 * sqrt(2) at aspect ratio 1, a cosine of sqrt(2 / 3).
    let ahead = at(v(-1.0, -1.0, -1.0), v(1.0, 1.0, 1.0));
    let behind = at(v(20.0, 0.0, 0.0), v(30.0, 1.0, 1.0));
    let around = at(v(-6374.0, -5.0, -5.0), v(11.0, 5.0, 5.0));
    let beside = at(v(9.0, 60.0, 0.0), v(11.0, 61.0, 0.0));
    let stray = at(v(-1e6, 0.0, 0.0), v(-1e6, 0.0, 0.0));
    let speck = at(v(9.999_999, 0.0, 0.0), v(10.000_001, 0.0, 0.0));
    let rows: [(&[Aabb], f64); 9] = [
        (&[], 1.0),
        (&[Aabb::EMPTY, behind], 1.0),
        (&[ahead], 9.0 * 15.0 / 16.0),
        (&[ahead, behind, Aabb::EMPTY], 9.0 * 15.0 / 16.0),
        // 16384 times as near as its farthest point, 6384 away.
        (&[around], 6384.0 / 16384.0),
        (&[ahead, around], 6384.0 / 16384.0),
        // Not in the image, since seen from 60 away; but that is all that is known of it.
        (&[beside], 60.0 * (2.0_f64 / 3.0).sqrt() * 15.0 / 16.0),
        // A part far away does not move it.
        (&[ahead, stray], 9.0 * 15.0 / 16.0),
        (&[speck, stray], (1e6 + 10.0) / 16_777_216.0),
    ];
    for (i, (boxes, near)) in rows.into_iter().enumerate() {
        let range = DepthRange::of(&from_plus_x(), 1.0, boxes);
        assert_eq!(range.far, f64::INFINITY);
        assert!(
            (range.near - near).abs() < 1e-12 * near,
            "{i}: {}",
            range.near
        );
    }
}

#[test]
fn near_planes_cut_nothing_that_is_seen() {
    // Boxes outside the eye, at random places: each corner that the image shows is behind near.
    let view = from_plus_x();
    let mut state = 1_u64;
    let mut next = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 33) as f64 / f64::from(1_u32 << 31) * 2.0 - 1.0
    };
    let mut seen = 0;
    for _ in 0..2000 {
        let middle = view.eye + v(next(), next(), next()) * 4.0;
        let half = v(next(), next(), next()).abs();
        let bounds = at(middle - half, middle + half);
        let range = DepthRange::of(&view, 1.5, &[bounds]);
        let planes = view.frustum_planes(1.5, range);
        for p in bounds.corners() {
            let in_image = planes[..4]
                .iter()
                .all(|plane| plane.dot(p.extend(1.0)) >= 0.0);
            let depth = -view.p_in_view(p).z;
            // The share of the object's own depth that may be cut.
            if in_image && depth > 6.0 / 16384.0 {
                seen += 1;
                assert!(
                    depth > range.near,
                    "{bounds:?}: {depth} before {}",
                    range.near
                );
            }
        }
    }
    assert!(seen > 500, "{seen}");
}

#[test]
fn orthographic_ranges_hold_all() {
    let view = orthographic_from_plus_x();
    let rows: [(&[Aabb], f64, f64); 5] = [
        (&[at(v(-1.0, -1.0, -1.0), v(1.0, 1.0, 1.0))], 9.0, 11.0),
        (&[at(v(-1.0, 0.0, 0.0), v(20.0, 0.0, 0.0))], -10.0, 11.0),
        (&[at(v(10.0, 0.0, 0.0), v(10.0, 0.0, 0.0))], 0.0, 0.0),
        (&[], 0.0, 0.0),
        (
            &[
                at(v(0.0, 0.0, 0.0), v(0.0, 0.0, 0.0)),
                Aabb::EMPTY,
                at(v(-90.0, 0.0, 0.0), v(-80.0, 0.0, 0.0)),
            ],
            10.0,
            100.0,
        ),
    ];
    for (boxes, from, to) in rows {
        let range = DepthRange::of(&view, 1.0, boxes);
        let room = (to.max(3.0)).max(-from) / 1024.0;
        assert!(
            (range.near - (from - room)).abs() < 1e-12,
            "{boxes:?}: {range:?}"
        );
        assert!(
            (range.far - (to + room)).abs() < 1e-12,
            "{boxes:?}: {range:?}"
        );
        assert!(view.clip_from_view(1.0, range).is_finite());
    }
}
