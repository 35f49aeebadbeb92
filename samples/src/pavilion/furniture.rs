//! Tables, chair, bench, counter, bowl and planter, each defined once with its foot at the origin.

use crate::iv_writer::{IvWriter, num};
use crate::solid::lathe;

/// Every piece of furniture.
pub(super) fn parts(w: &mut IvWriter) {
    chair(w);
    long_table(w);
    round_table(w);
    bench(w);
    counter(w);
    fruit_bowl(w);
    planter(w);
}

/// The sitter looks along -y.
fn chair(w: &mut IvWriter) {
    w.node("DEF Chair Separator", |w| {
        w.line("USE Oak");
        w.node("DEF ChairLeg Separator", |w| {
            w.cuboid([-0.21, -0.21, 0.0], [-0.175, -0.175, 0.43]);
        });
        w.placed([0.385, 0.0, 0.0], 0.0, |w| w.line("USE ChairLeg"));
        for x in [-0.21, 0.175] {
            w.cuboid([x, 0.175, 0.0], [x + 0.035, 0.21, 0.88]);
        }
        w.cuboid([-0.22, -0.22, 0.43], [0.22, 0.21, 0.455]);
        for z in [0.58, 0.69, 0.8] {
            w.cuboid([-0.175, 0.183, z], [0.175, 0.2, z + 0.06]);
        }
    });
}

fn long_table(w: &mut IvWriter) {
    w.node("DEF LongTable Separator", |w| {
        w.line("USE Oak");
        w.cuboid([-1.2, -0.45, 0.725], [1.2, 0.45, 0.76]);
        w.node("DEF TableLeg Separator", |w| {
            w.cuboid([-1.1, -0.4, 0.0], [-1.02, -0.32, 0.725]);
        });
        for (x, y) in [(2.12, 0.0), (0.0, 0.72), (2.12, 0.72)] {
            w.placed([x, y, 0.0], 0.0, |w| w.line("USE TableLeg"));
        }
        for y in [-0.375, 0.345] {
            w.cuboid([-1.02, y, 0.62], [1.02, y + 0.03, 0.725]);
        }
    });
}

fn round_table(w: &mut IvWriter) {
    w.node("DEF RoundTable Separator", |w| {
        w.line("USE Larch");
        let profile = [
            [0.24, 0.0],
            [0.24, 0.03],
            [0.05, 0.07],
            [0.04, 0.68],
            [0.12, 0.7],
            [0.42, 0.71],
            [0.42, 0.74],
        ];
        w.solid(&lathe(&profile, 20));
    });
}

fn bench(w: &mut IvWriter) {
    w.node("DEF Bench Separator", |w| {
        w.line("USE Larch");
        for x in [0.1, 1.64] {
            w.cuboid([x, 0.03, 0.0], [x + 0.06, 0.37, 0.4]);
        }
        for slat in 0..4 {
            let y = 0.01 + f64::from(slat) * 0.098;
            w.cuboid([0.0, y, 0.4], [1.8, y + 0.086, 0.43]);
        }
    });
}

fn counter(w: &mut IvWriter) {
    w.node("DEF Counter Separator", |w| {
        w.line("USE PaintedGreen");
        w.cuboid([0.0, 0.06, 0.08], [2.54, 0.62, 0.87]);
        w.line("USE Limestone");
        w.cuboid([0.0, 0.0, 0.87], [2.54, 0.62, 0.91]);
        w.line("USE Brass");
        for door in 0..4 {
            let x = 0.54 + f64::from(door) * 0.62;
            w.cuboid([x, 0.045, 0.6], [x + 0.012, 0.06, 0.74]);
        }
    });
}

/// A shallow bowl, open inside, with five oranges.
fn fruit_bowl(w: &mut IvWriter) {
    w.node("DEF FruitBowl Separator", |w| {
        w.line("USE Ceramic");
        let profile = [
            [0.06, 0.0],
            [0.11, 0.012],
            [0.168, 0.07],
            [0.16, 0.07],
            [0.1, 0.02],
        ];
        w.solid(&lathe(&profile, 20));
        w.line("USE Orange");
        let oranges = [
            [0.05, 0.03, 0.055],
            [-0.06, 0.03, 0.056],
            [0.01, -0.07, 0.055],
            [0.08, -0.05, 0.066],
            [0.0, 0.0, 0.11],
        ];
        for centre in oranges {
            w.node("Separator", |w| {
                w.translation(centre);
                w.line(&format!("Sphere {{ radius {} }}", num(0.042)));
            });
        }
    });
}

/// A clay pot with a clipped box tree.
fn planter(w: &mut IvWriter) {
    w.node("DEF Planter Separator", |w| {
        w.line("USE Terracotta");
        let profile = [
            [0.15, 0.0],
            [0.2, 0.34],
            [0.23, 0.34],
            [0.23, 0.4],
            [0.19, 0.4],
            [0.18, 0.36],
        ];
        w.solid(&lathe(&profile, 20));
        w.line("USE Bark");
        w.upright_cylinder([0.0, 0.0, 0.36], 0.02, 0.14);
        w.line("USE Boxwood");
        w.node("Separator", |w| {
            w.translation([0.0, 0.0, 0.72]);
            w.line("Sphere { radius 0.27 }");
        });
    });
}
