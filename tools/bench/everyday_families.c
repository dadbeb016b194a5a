/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/everyday.h"

#include <stddef.h>

/* --- Words ------------------------------------------------------------------------------------ */

#define BOX(SIZE, CENTER) "{'type':'box','size':[" SIZE "],'center':[" CENTER "]}"
#define CYLINDER(RADIUS, HEIGHT, CENTER)                                                           \
    "{'type':'cylinder','radius':" RADIUS ",'height':" HEIGHT ",'center':[" CENTER "]}"
#define CAN(RADIUS, HEIGHT, CENTER)                                                                \
    "{'type':'cylinder','ends':true,'radius':" RADIUS ",'height':" HEIGHT ",'center':[" CENTER "]" \
    "}"
#define SPHERE(RADIUS, CENTER) "{'type':'sphere','radius':" RADIUS ",'center':[" CENTER "]}"
#define TORUS(MAJOR, MINOR) "{'type':'torus','major_radius':" MAJOR ",'minor_radius':" MINOR "}"
#define PLANE(ORIGIN, U, V)                                                                        \
    "{'type':'plane','origin':[" ORIGIN "],'edge_u':[" U "],'edge_v':[" V "]}"
#define CONE(Z) "{'type':'cone','center':[0,0," Z "]}"
#define CAPSULE(RADIUS, FROM, TO)                                                                  \
    "{'type':'capsule','radius':" RADIUS ",'from':[" FROM "],'to':[" TO "]}"
#define DISC(RADIUS, CENTER) "{'type':'disc','radius':" RADIUS ",'center':[" CENTER "]}"
#define LATHE(TEXT) "{<" TEXT ">}"

#define TURN(AXIS, RATE) "{'type':'rotate','axis':[" AXIS "],'rate':" RATE "}"
#define TURN_AT(AXIS, RATE, CENTER)                                                                \
    "{'type':'rotate','axis':[" AXIS "],'rate':" RATE ",'center':[" CENTER "]}"
#define MOVE(VELOCITY) "{'type':'translate','velocity':[" VELOCITY "]}"
#define SCALE(FACTOR) "{'type':'scale','factor':[" FACTOR "," FACTOR "," FACTOR "]}"

/* A place that only its angle shows to be common to both. */
#define PLACE "{'type':'rotate','axis':[1,2,3],'angle':[0.7]}"
#define SAME_PLACE                                                                                 \
    "{'type':'rotate','axis':[1,2,3],'angle':[0.5]},{'type':'rotate','axis':[1,2,3],'angle':[0.2]" \
    "}"

/* Lays what stands along z along y. */
#define LAID "{'type':'rotate','axis':[1,0,0],'angle':[1.5707963267948966]}"
#define PUT(AT) "{'type':'translate','offset':[[" AT "]]}"

/* Takes x, y and z to (2,-1,2)/3, (2,2,-1)/3 and (-1,2,2)/3, in which coordinates the motions that
 * follow are written, as CAD exports them. */
#define INCLINE "{'type':'rotate','axis':[1,1,1],'angle':[-1.0471975511965976]}"
#define INCLINED "-1,2,2"

#define Z_AXIS "0,0,1"
#define TUMBLE TURN("1,2,3", "2") "," TURN_AT("0,1,0", "1.5", "3,0,0") "," MOVE("5,1,0")
#define WHIRL TURN("1,2,3", "20") "," MOVE("5,1,0")
#define HAND BOX("2,2,1", "0,0,-0.5")
#define FLOOR PLANE("-3,-3,0", "6,0,0", "0,6,0")
#define WALL PLANE("@1,-3,-3", "0,6,0", "0,0,6")
#define FOLIAGE                                                                                    \
    "p 16 0.38268343236508977:-0.92387953251128674 0.70710678118654757:-0.70710678118654757 "      \
    "0.92387953251128674:-0.38268343236508977 1:0 0.92387953251128674:0.38268343236508977 "        \
    "0.70710678118654757:0.70710678118654757 0.38268343236508977:0.92387953251128674"
/* A tube of 64 sides, whose sides are 1 from its axis. */
#define TUBE "op 64 1.0012060077811093:-1 1.0012060077811093:1"
/* A tube of 32 sides, closed by rings at its ends; its inner sides are 1 from its axis. */
#define RING "32 1.5:-0.5 1.5:0.5 1.0048385723763114:0.5 1.0048385723763114:-0.5 1.5:-0.5"
#define SCREW "{'type':'screw','pitch':0.5,'rate':1}"
#define THREAD(RADIUS, HEIGHT) "{'type':'thread','radius':" RADIUS ",'height':" HEIGHT "}"
#define THREADS(RADIUS, HEIGHT)                                                                    \
    "{'type':'thread','radius':" RADIUS ",'starts':2,'height':" HEIGHT "}"
#define THREAD_BY_FORMULA(RADIUS, FROM, TO)                                                        \
    "{'type':'formula','x':'(r+0.1*cos(2*pi*(v-u)))*cos(2*pi*u)','y':'(r+0.1*cos(2*pi*(v-u)))*"    \
    "sin(2*pi*u)','z':'0.5*v','domain':[[0,1],[" FROM "," TO "]],'constants':{'r':" RADIUS "}}"
#define SHEET                                                                                      \
    "{'type':'bezier','degree':[2,2],'points':[[-1,-1,@0],[-1,0,@0],[-1,1,@0],[0,-1,@0],[0,0,@0]," \
    "[0,1,@0],[1,-1,@0],[1,0,@0],[1,1,@0]]}"
#define BOUNCE                                                                                     \
    "{'type':'trajectory','times':[0,0.5,1],'positions':[[0,0,1],[0,0,0],[0,0,1]],"                \
    "'accelerations':[[0,0,-2],[0,0,-2]]}"

/* A piston on a crank of length 0.4 with a rod of 1.2: by formula, and by a table of it. */
#define CRANK                                                                                      \
    "{'type':'motion-formula','offset':['0','0','r*cos(9*t)+sqrt(1.44-(r*sin(9*t))^2)'],"          \
    "'constants':{'r':0.4}}"
#define CRANK_TABLE                                                                                \
    "{'type':'translate','interpolation':'cubic','times':[0,0.125,0.25,0.375,0.5,0.625,0.75,"      \
    "0.875,1],'positions':[[0,0,1.6],[0,0,1.316912],[0,0,0.907668],[0,0,0.807275],[0,0,1.05019],[" \
    "0,0,1.491233],[0,0,1.543623],[0,0,1.122995],[0,0,0.824171]]}"
#define SWING(AXIS) "{'type':'motion-formula','angle':'0.6*sin(6*t)','axis':[" AXIS "]}"

#define TURNED(PROFILE) "{'type':'revolution','profile':[" PROFILE "]}"
#define TURNED_ARC(PROFILE) "{'type':'revolution','weights':[1,1,2],'profile':[" PROFILE "]}"
/* A surface of revolution by formula: R and Z in v, from FROM to TO. */
#define TURNED_BY_FORMULA(R, Z, FROM, TO)                                                          \
    "{'type':'formula','x':'(" R ")*cos(u)','y':'(" R ")*sin(u)','z':'" Z                          \
    "','domain':[[0,6.283185307179586],[" FROM "," TO "]],'constants':{'r':"
#define VASE TURNED("[0.6,-1],[1.5,-0.4],[0,0.4],[0.6,1]")
#define EXTRUSION(PROFILE, HEIGHT)                                                                 \
    "{'type':'extrusion','degree':1,'profile':[" PROFILE "],'vector':[0,0," HEIGHT "]"
#define HEXAGON                                                                                    \
    "[1.1547005383792517,0],[0.5773502691896258,1],[-0.5773502691896258,1],"                       \
    "[-1.1547005383792517,0],[-0.5773502691896258,-1],[0.5773502691896258,-1],"                    \
    "[1.1547005383792517,0]"
/* Four splines: a cross of that reach, and of that half width; and their negative values. */
#define CROSS(R, W, R_, W_)                                                                        \
    "[" R "," W "],[" W "," W "],[" W "," R "],[" W_ "," R "],[" W_ "," W "],[" R_ "," W "],[" R_  \
    "," W_ "],[" W_ "," W_ "],[" W_ "," R_ "],[" W "," R_ "],[" W "," W_ "],[" R "," W_ "],[" R    \
    "," W "]"

/* A whole turn of four rational arcs: their control points at one height, and weights. */
#define ARCS                                                                                       \
    "'degree':2,'knots':[0,0,0,1,1,2,2,3,3,4,4,4],'weights':[1,0.70710678118654757,1,0."           \
    "70710678118654757,1,0.70710678118654757,1,0.70710678118654757,1]"
#define RING_OF_ARCS(R, R_)                                                                        \
    "[" R ",0],[" R "," R "],[0," R "],[" R_ "," R "],[" R_ ",0],[" R_ "," R_ "],[0," R_ "],[" R   \
    "," R_ "],[" R ",0]"
#define ARC_ROW(X, Y, Z) "[" X "," Y ",-" Z "],[" X "," Y "," Z "]"
#define NURBS_CYLINDER(R, R_, Z)                                                                   \
    "{'type':'nurbs','degree':[2,1],'knots_u':[0,0,0,1,1,2,2,3,3,4,4,4],'knots_v':[0,0,1,1],"      \
    "'points':[" ARC_ROW(R, "0", Z) "," ARC_ROW(R, R, Z) "," ARC_ROW("0", R, Z) "," ARC_ROW(       \
        R_, R,                                                                                     \
        Z) "," ARC_ROW(R_, "0",                                                                    \
                       Z) "," ARC_ROW(R_, R_,                                                      \
                                      Z) "," ARC_ROW("0", R_,                                      \
                                                     Z) "," ARC_ROW(R, R_,                         \
                                                                    Z) "," ARC_ROW(R, "0",         \
                                                                                   Z) "],'"        \
                                                                                      "weights':[" \
                                                                                      "1,"         \
                                                                                      "1," CORNER  \
                                                                                      ",1,"        \
                                                                                      "1," CORNER  \
                                                                                      ",1,"        \
                                                                                      "1," CORNER  \
                                                                                      ",1,"        \
                                                                                      "1," CORNER  \
                                                                                      ",1,1]}"
#define CORNER "0.70710678118654757,0.70710678118654757"

/* Poses of a wheel of radius 0.5 that rolls along x, by a table. */
#define ROLLS                                                                                      \
    "{'type':'keyframes','times':[0,0.25,0.5,0.75,1],'positions':[[0,0,0],[0.25,0,0],[0.5,0,0],"   \
    "[0.75,0,0],[1,0,0]],'rotations':[[1,0,0,0],[0.96891242171064478,0,0,-0.24740395925452294],"   \
    "[0.87758256189037276,0,0,-0.47942553860420301],[0.73168886887382090,0,0,-0."                  \
    "68163876002333412],[0.54030230586813977,0,0,-0.84147098480789650]]}"
#define TWIST "{'type':'twist','axis':[0,0,1],'rate':0.5}"

#define FIVE "12346"

/* --- Families --------------------------------------------------------------------------------- */

const everyday_family everyday_families[] = {
    /* carried */
    {"box on a hand", HAND, TUMBLE, BOX("1,1,1", "0,0,@0.5"), "", BOND_PARENT, 0, false, FIVE, 100,
     "", ""},
    {"box on a hand that whirls", HAND, WHIRL, BOX("1,1,1", "0,0,@0.5"), "", BOND_TWICE, 0, false,
     FIVE, 100, "", ""},
    {"slider in a rail that turns", BOX("6,1,1", "0,-1.5,0") "," BOX("6,1,1", "0,1.5,0"), TUMBLE,
     BOX("1,~2,1", "0,0,0"), MOVE("1,0,0"), BOND_PARENT, 0, false, FIVE, 500, "", ""},
    {"ball joint, carried", SPHERE("1", "0,0,0"), TUMBLE, SPHERE("~1", "0,0,0"), TURN("1,2,3", "2"),
     BOND_PARENT, 0, false, "1234", 1000, "", ""},
    {"cylinders, carried", CYLINDER("1", "4", "0,0,0"), TUMBLE, CYLINDER("1", "4", "@2,0,0"), "",
     BOND_PARENT, 0, false, FIVE, 100, "", ""},
    {"pin of a hinge", CYLINDER("0.2", "1", "0,0,0"), TUMBLE, CYLINDER("~0.2", "2", "0,0,0"),
     TURN(Z_AXIS, "2"), BOND_PARENT, 0, false, FIVE, 50, "", ""},
    /* faces */
    {"door above the floor", FLOOR, PLACE, BOX("1,0.1,2", "0.6,0,@1"),
     TURN(Z_AXIS, "1.5") "," SAME_PLACE, BOND_NONE, 0, false, FIVE, 500, "", ""},
    {"door between floor and lintel", BOX("4,4,1", "0,0,-0.5") "," BOX("4,0.2,1", "0,0,2.5"), "",
     BOX("1,0.1,~2", "0.6,0,1"), TURN(Z_AXIS, "1.5"), BOND_NONE, 0, false, FIVE, 1000, "", ""},
    {"lid that turns on a box", BOX("1,1,1", "0,0,-0.5"), PLACE, DISC("1", "0,0,@0"),
     TURN(Z_AXIS, "3") "," SAME_PLACE, BOND_NONE, 0, false, FIVE, 100, "", ""},
    {"can that turns on a table", FLOOR, PLACE,
     "{'type':'cylinder','ends':true,'center':[0.3,0,@1]}", TURN(Z_AXIS, "3") "," SAME_PLACE,
     BOND_NONE, 0, false, FIVE, 100, "", ""},
    {"sheet that turns above a table", FLOOR, PLACE, SHEET, TURN(Z_AXIS, "2") "," SAME_PLACE,
     BOND_NONE, 0, false, FIVE, 500, "", ""},
    {"box that turns on an inclined table", LATHE("pi 4 4:-1 4:0"), "", LATHE("pi 4 0.7:@0 0.7:1"),
     TURN("-1,2,2", "2"), BOND_NONE, 0, false, FIVE, 2000, "", ""},
    {"box that slides down a table", LATHE("pi 4 4:-1 4:0"), "", LATHE("pi 4 0.7:@0 0.7:1"),
     MOVE("1.5,1.5,-0.75"), BOND_NONE, 0, false, FIVE, 500, "", ""},
    /* symmetries */
    {"rollers", CYLINDER("1", "4", "0,0,0"), TURN(Z_AXIS, "20"), CYLINDER("1", "4", "@2,0,0"),
     TURN_AT(Z_AXIS, "-20", "@2,0,0"), BOND_NONE, 0, false, FIVE, 50, "", ""},
    {"rollers with ends", CAN("1", "4", "0,0,0"), TURN(Z_AXIS, "20"), CAN("1", "3", "@2,0,0.1"),
     TURN_AT(Z_AXIS, "-20", "@2,0,0"), BOND_NONE, 0, false, FIVE, 50, "", ""},
    {"shaft with ends that whirls in a bore", CYLINDER("1", "2", "0,0,0"), "",
     CAN("0.9", "1", "~0.1,0,0"), TURN_AT(Z_AXIS, "5", "~0.1,0,0") "," TURN(Z_AXIS, "1"), BOND_NONE,
     0, false, FIVE, 1000, "", ""},
    {"roller beside a plate", CYLINDER("1", "4", "0,0,0"), TURN(Z_AXIS, "100"), WALL, "", BOND_NONE,
     0, false, FIVE, 50, "", ""},
    {"wheel that rolls along a wall", CYLINDER("1", "4", "0,-1,0"),
     TURN_AT(Z_AXIS, "2", "0,-1,0") "," MOVE("0,2,0"), WALL, "", BOND_NONE, 0, false, FIVE, 100, "",
     ""},
    {"ball that rolls on a floor", SPHERE("1", "-1,0,@1"),
     TURN_AT("0,1,0", "2", "-1,0,@1") "," MOVE("2,0,0"), FLOOR, "", BOND_NONE, 0, false, FIVE, 100,
     "", ""},
    {"disc beside a ball", TORUS("1", "0.25"), TURN(Z_AXIS, "100"), SPHERE("0.5", "@1.75,0,0"), "",
     BOND_NONE, 0, false, FIVE, 50, "", ""},
    {"roller that orbits in a bore", CYLINDER("1", "3", "0,0,0"), "",
     CYLINDER("0.2", "1", "~0.8,0,0"), TURN_AT(Z_AXIS, "5", "~0.8,0,0") "," TURN(Z_AXIS, "1"),
     BOND_NONE, 0, false, FIVE, 50, "", ""},
    {"shaft in a bore", CYLINDER("1", "2", "0,0,0"), "", CYLINDER("~1", "2", "0,0,0"),
     TURN(Z_AXIS, "3"), BOND_NONE, 0, false, FIVE, 50, "", ""},
    {"piston", CYLINDER("1", "4", "0,0,0"), "", CYLINDER("~1", "1", "0,0,0"), MOVE("0,0,0.5"),
     BOND_NONE, 0, false, FIVE, 300, "", ""},
    {"cone in a cone", CONE("0"), "", CONE("~0"), TURN(Z_AXIS, "3"), BOND_NONE, 0, false, FIVE, 500,
     "", ""},
    {"cone that is drawn from a cone", CONE("0"), "", CONE("~0"), MOVE("0,0,-1"), BOND_NONE, 0,
     false, FIVE, 500, "", ""},
    {"ball in its groove", TORUS("1", "@0.2"), "", SPHERE("0.2", "1,0,0"),
     TURN_AT("0,1,0", "5", "1,0,0") "," TURN(Z_AXIS, "1"), BOND_NONE, 0, false, "1234", 2000, "",
     ""},
    {"ellipsoid in its hollow", "{'type':'ellipsoid','radii':[1.5,1,1]}", "",
     "{'type':'ellipsoid','radii':[~1.5,~1,~1]}", TURN("1,0,0", "2"), BOND_NONE, 0, false, "1234",
     1000, "", ""},
    {"capsules that slide along", CAPSULE("0.5", "0,0,-1", "0,0,1"), "",
     CAPSULE("0.5", "@1,0,-1", "@1,0,1"), MOVE("0,0,0.5"), BOND_NONE, 0, false, FIVE, 100, "", ""},
    /* turned profiles */
    {"vase that turns in a vase", VASE, TURN(Z_AXIS, "-7"),
     TURNED("[~0.6,-1],[~1.5,-0.4],[~0,0.4],[~0.6,1]"), TURN(Z_AXIS, "20"), BOND_NONE, 0, false,
     "1234", 2000, "", ""},
    {"vases that turn beside each other", VASE, TURN(Z_AXIS, "20"), VASE,
     TURN(Z_AXIS, "-7") ",{'type':'translate','offset':[[@1.9,0,0.1]]}", BOND_NONE, 0, false, FIVE,
     100, "", ""},
    {"turned roller that whirls in a bore", TURNED("[1,-1],[1,1]"), TURN(Z_AXIS, "2"),
     TURNED("[~0.9,-0.5],[~0.9,0.5]"),
     TURN(Z_AXIS, "20") ",{'type':'translate','offset':[[0.1,0,0]]}," TURN(Z_AXIS, "5"), BOND_NONE,
     0, false, FIVE, 500, "", ""},
    {"ball in a groove, by formula",
     TURNED_BY_FORMULA("3+r*cos(v)", "r*sin(v)", "-0.9", "0.9") "@0.5}}", "",
     SPHERE("0.5", "3,0,0"), TURN(Z_AXIS, "4"), BOND_NONE, 0, false, FIVE, 10, "", ""},
    {"taper in a taper, by formula", TURNED_BY_FORMULA("r-0.2*v", "v", "-0.5", "0.5") "@3}}", "",
     TURNED_BY_FORMULA("r-0.2*v", "v", "-0.5", "0.5") "3}}", TURN(Z_AXIS, "10"), BOND_NONE, 0,
     false, "1234", 10, "", ""},
    {"vase that turns in a vase, by formula",
     TURNED_BY_FORMULA("r+0.2*sin(3*v)", "v+0.1*v^2", "-1", "1") "@1}}", TURN(Z_AXIS, "-7"),
     TURNED_BY_FORMULA("r+0.2*sin(3*v)", "v+0.1*v^2", "-1", "1") "1}}", TURN(Z_AXIS, "20"),
     BOND_NONE, 0, false, "1234", 2000, "", ""},
    {"turned plug in a cone", CONE("0"), "", TURNED("[0.75,0.25],[0.5,0.5]"),
     TURN(Z_AXIS, "20") ",{'type':'translate','offset':[[0,0,~0]]}", BOND_NONE, 0, false, FIVE, 100,
     "", ""},
    {"ball in a groove of two arcs",
     TURNED_ARC("[1,-0.2],[0.8,-0.2],[0.8,0]") "," TURNED_ARC("[1,0.2],[0.8,0.2],[0.8,0]"), "",
     SPHERE("~0.2", "1,0,0"), TURN_AT("1,0,0", "5", "1,0,0") "," TURN(Z_AXIS, "4"), BOND_NONE, 0,
     false, FIVE, 100, "", ""},
    /* NURBS that are round */
    {"shaft of NURBS that turns in a bore of NURBS", NURBS_CYLINDER("1", "-1", "1"), "",
     NURBS_CYLINDER("~1", "@-1", "0.5"), TURN(Z_AXIS, "3"), BOND_NONE, 0, false, "1234", 50, "",
     ""},
    {"rollers of NURBS", NURBS_CYLINDER("1", "-1", "1"), TURN(Z_AXIS, "20"),
     NURBS_CYLINDER("1", "-1", "0.9"), TURN(Z_AXIS, "-20") "," PUT("@2,0,0"), BOND_NONE, 0, false,
     "1234", 50, "", ""},
    {"roller of NURBS on a table", NURBS_CYLINDER("1", "-1", "1"),
     TURN(Z_AXIS, "-4") "," LAID ",{'type':'translate','offset':[[-1,0,@1],[2,0,0]]}", FLOOR, "",
     BOND_NONE, 0, false, "1234", 10, "", ""},
    {"box that passes a roller of NURBS", NURBS_CYLINDER("1", "-1", "1"), TURN(Z_AXIS, "20"),
     BOX("1,1,1", "@1.5,-1,0"), MOVE("0,2,0"), BOND_NONE, 0, false, "1234", 10, "", ""},
    {"can that turns in a bore of NURBS", NURBS_CYLINDER("1", "-1", "1"), PLACE,
     CAN("~1", "1", "0,0,0"), TURN(Z_AXIS, "3") "," SAME_PLACE, BOND_NONE, 0, false, FIVE, 10, "",
     ""},
    {"can that slides in an extruded bore of arcs",
     "{'type':'extrusion','vector':[0,0,2],'profile':[" RING_OF_ARCS("1", "-1") "]," ARCS "}", "",
     CAN("~1", "1", "0,0,1"), TURN(Z_AXIS, "5") "," MOVE("0,0,0.2"), BOND_NONE, 0, false, FIVE, 10,
     "", ""},
    /* meshes */
    {"shaft of 64 sides in a round bore", CYLINDER("1", "2", "0,0,0"), "",
     LATHE("p 64 ~1:-0.75 ~1:0.75"), TURN(Z_AXIS, "3"), BOND_NONE, 0, false, "1234", 20000, "", ""},
    {"shaft in a bore of 64 sides", LATHE(TUBE), "", LATHE("p 64 ~1:-0.75 ~1:0.75"),
     TURN(Z_AXIS, "3"), BOND_NONE, 0, false, "123", 20000, "", ""},
    {"piston in a sleeve of 64 sides", LATHE(TUBE), "", LATHE("p 64 ~1:-0.5 ~1:0.5"),
     MOVE("0,0,0.25"), BOND_NONE, 0, false, "1234", 2000, "", ""},
    {"nested copies of a mesh", LATHE(FOLIAGE), "", LATHE(FOLIAGE), SCALE("~1"), BOND_NONE, 0,
     false, "1234", 2000, "", ""},
    {"nested copies of a mesh, carried", LATHE(FOLIAGE), TUMBLE, LATHE(FOLIAGE), SCALE("~1"),
     BOND_PARENT, 0, false, "1234", 2000, "", ""},
    {"gears whose tips pass", LATHE("p 64 1/0.85:0 1/0.85:0.3"), TURN(Z_AXIS, "2"),
     LATHE("p 64 1/0.85:0 1/0.85:0.3"),
     MOVE("0,0,0") "," TURN(Z_AXIS, "-2") ","
                                          "{'type':'translate','offset':[[@2,0,0]]}",
     BOND_NONE, 0, false, "123", 20000, "", ""},
    /* threads */
    {"nut on its bolt", THREAD("~1", "2"), "", THREAD("1", "0.5"), SCREW, BOND_NONE, 0, false, FIVE,
     1000, "", ""},
    {"nut on its bolt by formula", THREAD_BY_FORMULA("~1", "-2", "2"), "",
     THREAD_BY_FORMULA("1", "-0.5", "0.5"), SCREW, BOND_NONE, 0, false, FIVE, 1000, "", ""},
    /* long and fast */
    {"cam and follower", CYLINDER("1", "1", "0.1,0,0"), TURN(Z_AXIS, "6"),
     PLANE("@1.1,-1,-1", "0,2,0", "0,0,2"), "", BOND_NONE, 0, false, FIVE, 500, "", ""},
    {"orbit over 100 units of time", SPHERE("0.5", "3,0,0"), TURN(Z_AXIS, "1"),
     SPHERE("0.5", "0,@4,0"), "", BOND_NONE, 100, false, "123", 2000, "", ""},
    {"orbit over 1000 units of time", SPHERE("0.5", "3,0,0"), TURN(Z_AXIS, "1"),
     SPHERE("0.5", "0,@4,0"), "", BOND_NONE, 1000, false, "12", 20000, "", ""},
    {"box at 1000 rad beside a ball", BOX("1,1,0.2", "0,0,0"), TURN(Z_AXIS, "1000"),
     SPHERE("0.5", "@1.2071067811865475,0,0"), "", BOND_NONE, 0, false, "123", 2000, "", ""},
    {"octagon at 100 rad in a bore", CYLINDER("1", "2", "0,0,0"), "", LATHE("p 8 ~1:-0.5 ~1:0.5"),
     TURN(Z_AXIS, "100"), BOND_NONE, 0, false, "1234", 2000, "", ""},
    /* landings */
    {"box that lands flat", FLOOR, PLACE, BOX("1,1,1", "0.3,0,@0.5"),
     MOVE("0,0,~0") "," MOVE("0,0,~0") "," SAME_PLACE, BOND_NONE, 0, true, FIVE, 500, "", ""},
    {"box that lands flat and turns", FLOOR, PLACE, BOX("1,1,1", "0.3,0,@0.5"),
     TURN(Z_AXIS, "1") "," MOVE("0,0,~0") "," MOVE("0,0,~0") "," SAME_PLACE, BOND_NONE, 0, true,
     FIVE, 500, "", ""},
    {"box that bounces on a table", FLOOR, PLACE, BOX("1,1,1", "0.3,0,@0.5"), BOUNCE "," SAME_PLACE,
     BOND_NONE, 0, false, FIVE, 500, "", ""},
    /* poles */
    {"balls that meet head-on", SPHERE("1", "0,0,0"), TURN("1,0,0", "3"), SPHERE("1", "0,0,4"),
     MOVE("0,0,-4"), BOND_NONE, 0, true, FIVE, 50, "", ""},
    {"ball that falls on a pole", "{'type':'ellipsoid','radii':[2,2,1]}", "",
     SPHERE("0.5", "0,0,3.5"), MOVE("0,0,-4"), BOND_NONE, 0, true, FIVE, 50, "", ""},
    {"ball that falls on an apex", "{'type':'cone','height':2}", PLACE,
     SPHERE("0.5", "0.1,0,4.4898979485566357"), MOVE("0,0,-4") "," SAME_PLACE, BOND_NONE, 0, true,
     FIVE, 50, "", ""},
    /* parts of machines */
    {"nut of two starts", THREADS("~1", "4"), "", THREADS("1", "1.5"), "", BOND_NONE, 0, false,
     "1234", 2000, "", ""},
    {"nut that is drawn along", THREAD("~0.8", "4"), "", THREAD("1", "0.75"), MOVE("0,0,0.5"),
     BOND_NONE, 0, false, "1234", 1000, "", ""},
    {"screw in a smooth bore", THREAD("1", "2"), TURN(Z_AXIS, "3"), CYLINDER("@1.1", "2", "0,0,0"),
     "", BOND_NONE, 0, false, "1234", 20000, "", ""},
    {"ball beside a screw", THREAD("1", "3"), TURN(Z_AXIS, "6"), SPHERE("0.1", "@1.25,0,0"),
     MOVE("0,0,0.3"), BOND_NONE, 0, false, "1234", 2000, "", ""},
    {"oval cam and roller", "{'type':'ellipsoid','radii':[1.5,1,1]}", TURN(Z_AXIS, "6"),
     CYLINDER("0.5", "1", "@2,0,0"), "", BOND_NONE, 0, false, "1234", 1000, "", ""},
    {"disc between rails", BOX("6,1,1", "0,~-1.5,0") "," BOX("6,1,1", "0,@1.5,0"), "",
     TORUS("0.75", "0.25"), TURN(Z_AXIS, "20") "," MOVE("1,0,0"), BOND_NONE, 0, false, "1234", 500,
     "", ""},
    /* turning beside others, without being round */
    {"thread turns beside a wall", THREAD("1", "2"), TURN(Z_AXIS, "2") "," PLACE,
     PLANE("@1.1,-2,-2", "0,4,0", "0,0,4"), SAME_PLACE, BOND_NONE, 0, false, "1234", 50, "", ""},
    {"threads turn beside each other", THREAD("1", "2"), TURN(Z_AXIS, "2") "," PLACE,
     THREAD("1", "2"), TURN(Z_AXIS, "-3") "," PUT("@2.2,0,0.1") "," SAME_PLACE, BOND_NONE, 0, false,
     "1234", 1000, "", ""},
    {"screw whirls in a smooth bore", CYLINDER("@1.3", "3", "0,0,0"), PLACE, THREAD("1", "2"),
     TURN(Z_AXIS, "2") "," PUT("0.2,0,0") "," TURN(Z_AXIS, "3") "," SAME_PLACE, BOND_NONE, 0, false,
     "1234", 50, "", ""},
    {"pin inside a thread that turns", THREAD("1", "2"), TURN(Z_AXIS, "2") "," PLACE,
     CYLINDER("~0.9", "3", "0,0,0"), SAME_PLACE, BOND_NONE, 0, false, "1234", 50, "", ""},
    {"shaft of 32 sides whirls in a bore", CYLINDER("@1", "3", "0,0,0"), PLACE,
     LATHE("p 32 0.8:-1 0.8:1"),
     TURN(Z_AXIS, "5") "," PUT("0.2,0,0") "," TURN(Z_AXIS, "3") "," SAME_PLACE, BOND_NONE, 0, false,
     "1234", 50, "", ""},
    {"roller of 64 sides on a table", BOX("5,1,4", "0.5,~-1,0"), PLACE,
     LATHE("p 64 0.5:-0.5 0.5:0.5"), TURN(Z_AXIS, "-2") "," MOVE("1,0,0") "," SAME_PLACE, BOND_NONE,
     0, false, "1234", 100, "", "4"},
    {"roller of 64 sides by a table of poses", BOX("5,1,4", "0.5,~-1,0"), PLACE,
     LATHE("p 64 0.5:-0.5 0.5:0.5"), ROLLS "," SAME_PLACE, BOND_NONE, 0, false, "1234", 100, "",
     ""},
    {"twisted bar turns in a bore", CYLINDER("@0.70710678118654757", "4", "0,0,0"), PLACE,
     BOX("1,1,3", "0,0,0"), TWIST "," TURN(Z_AXIS, "2") "," SAME_PLACE, BOND_NONE, 0, false, "1234",
     50, "", "4"},
    {"oval cam turns beside a wall", "{'type':'ellipsoid','radii':[1,0.6,0.4]}",
     TURN(Z_AXIS, "7") "," PLACE, PLANE("@1,-2,-2", "0,4,0", "0,0,4"), SAME_PLACE, BOND_NONE, 0,
     false, "1234", 50, "", ""},
    /* straight profiles */
    {"hex nut in its socket", EXTRUSION(HEXAGON, "2") "}", PLACE,
     EXTRUSION(HEXAGON, "1") ",'ends':true}",
     "{'type':'scale','factor':[~1,~1,1]}," MOVE("0,0,0.5") "," SAME_PLACE, BOND_NONE, 0, false,
     FIVE, 100, "", ""},
    {"splined shaft in its hub", EXTRUSION(CROSS("1", "0.3", "-1", "-0.3"), "2") "}", PLACE,
     EXTRUSION(CROSS("~1", "~0.3", "@-1", "@-0.3"), "1") ",'ends':true}",
     MOVE("0,0,0.5") "," SAME_PLACE, BOND_NONE, 0, false, FIVE, 1000, "", ""},
    /* in turned coordinates */
    {"box turns and slides on a plane, turned", PLANE("-4,-1,-1", "4,-2,4", "4,4,-2"), "",
     BOX("1,1,1", "0,0,@0.5"), INCLINE "," TURN(INCLINED, "1.3") "," MOVE("0.6,0.6,-0.3"),
     BOND_NONE, 0, false, FIVE, 50, "", ""},
    {"box turns and slides on a box, turned", BOX("2,1.3,0.6", "0,0,-0.3"), INCLINE,
     BOX("0.7,0.4,0.4", "0.9,0,@0.2"),
     INCLINE "," TURN_AT(INCLINED, "0.8", "0.7,0.2,0.4") "," MOVE("0.2,-0.2,0.3"), BOND_NONE, 0,
     false, FIVE, 50, "", ""},
    {"scissors, turned", BOX("1.6,0.15,0.04", "0.4,0,-0.02"), INCLINE "," TURN(INCLINED, "-1.1"),
     BOX("1.6,0.15,0.04", "0.4,0,@0.02"), INCLINE "," TURN(INCLINED, "1.2"), BOND_NONE, 0, false,
     FIVE, 50, "", ""},
    {"disc of a brake, turned",
     BOX("0.3,0.4,0.1", "0.8,0,@0.14") "," BOX("0.3,0.4,0.1", "0.8,0,~-0.14"), INCLINE,
     CAN("1", "0.18", "0,0,0"), INCLINE "," TURN(INCLINED, "20"), BOND_NONE, 0, false, FIVE, 500,
     "", ""},
    {"knuckles of a hinge, turned", CAN("0.1", "0.3", "0,0,@0.15"), INCLINE,
     CAN("0.1", "0.3", "0,0,-0.15"), INCLINE "," TURN(INCLINED, "1.8"), BOND_NONE, 0, false, FIVE,
     100, "", ""},
    {"shaft slides in its bore, turned", CYLINDER("1", "2", "0,0,0"), INCLINE,
     CYLINDER("~1", "3", "0,0,0"), INCLINE "," TURN(INCLINED, "20") "," MOVE("-0.1,0.2,0.2"),
     BOND_NONE, 0, false, FIVE, 50, "", ""},
    {"can slides and spins on a disc, turned", DISC("1.9", "0,0,0"),
     INCLINE "," TURN(INCLINED, "-2.3"), CAN("0.31", "0.8", "0.6,0.3,@0.4"),
     INCLINE "," TURN_AT(INCLINED, "5.1", "0.6,0,0.3") "," MOVE("-0.4,0.2,-0.4"), BOND_NONE, 0,
     false, FIVE, 500, "", ""},
    /* turning within themselves while they move */
    {"roller with ends on a table", FLOOR, TUMBLE, CAN("0.3", "0.9", "0,0,0"),
     TURN(Z_AXIS, "-3") "," LAID "," PUT("-0.7,0,@0.3") "," MOVE("0.9,0,0"), BOND_PARENT, 0, false,
     FIVE, 50, "", ""},
    {"flanged wheel on its rail", BOX("3,0.15,0.3", "0,0,-0.15"), TUMBLE,
     CAN("0.4", "0.2", "0,0,0") "," CAN("0.5", "0.05", "0,0,~-0.125"),
     TURN(Z_AXIS, "-2") "," LAID "," PUT("-0.4,0,@0.4") "," MOVE("0.8,0,0"), BOND_PARENT, 0, false,
     FIVE, 50, "", ""},
    {"fast spindle beside a box", BOX("0.5,1,1", "@0.45,0,0.02"), "", CAN("0.2", "0.8", "0,0,0"),
     TURN(Z_AXIS, "500") "," MOVE("0,0.4,0"), BOND_NONE, 0, false, FIVE, 50, "", ""},
    {"board that is drawn over a roller", CAN("0.3", "0.9", "0,0,0"), TURN(Z_AXIS, "6") "," LAID,
     BOX("3,1,0.1", "0,0,@0.35"), MOVE("1,0,0"), BOND_NONE, 0, false, FIVE, 50, "", ""},
    {"tyre on a table", FLOOR, TUMBLE, TORUS("0.75", "0.25"),
     TURN(Z_AXIS, "-1") "," LAID "," PUT("-0.5,0,@1") "," MOVE("1,0,0"), BOND_PARENT, 0, false,
     FIVE, 50, "", ""},
    {"capsule that rolls on a table", FLOOR, TUMBLE, CAPSULE("0.3", "0,0,-0.45", "0,0,0.45"),
     TURN(Z_AXIS, "-3") "," LAID "," PUT("-0.7,0,@0.3") "," MOVE("0.9,0,0"), BOND_PARENT, 0, false,
     FIVE, 50, "", ""},
    {"capsule that spins beside a box", BOX("0.5,1,1", "@0.45,0,0.02"), "",
     CAPSULE("0.2", "0,0,-0.3", "0,0,0.3"), TURN(Z_AXIS, "500") "," MOVE("0,0.4,0"), BOND_NONE, 0,
     false, FIVE, 50, "", ""},
    {"roller under a sheet that is drawn", SHEET, MOVE("0.5,0,0"), CAN("0.3", "0.9", "0,0,0"),
     TURN(Z_AXIS, "20") "," LAID "," PUT("0,0,-0.3"), BOND_NONE, 0, false, FIVE, 50, "", ""},
    /* sharing motion that is not at the end of their maps, or that cancels */
    {"box turns and slides along the axis, one beside it turns", BOX("1,1,1", "0,0,0"),
     TURN(Z_AXIS, "2") "," MOVE("0,0,0.5"), BOX("1,1,3", "@1,0,0"), TURN(Z_AXIS, "2"), BOND_NONE, 0,
     false, FIVE, 10, "", ""},
    {"box turns and slides along the axis, turned", BOX("1,1,3", "@1,0,0"),
     INCLINE "," TURN(INCLINED, "2"), BOX("1,1,1", "0,0,0"),
     INCLINE "," TURN(INCLINED, "2") "," MOVE("-0.2,0.4,0.4"), BOND_NONE, 0, false, FIVE, 10, "",
     ""},
    {"box whose turns cancel", BOX("1,1,1", "0,0,0"), "", BOX("1,1,1", "@1,0,0"),
     TURN_AT("1,2,3", "2", "3,2,1") "," TURN_AT("1,2,3", "-2", "3,2,1"), BOND_NONE, 0, false, FIVE,
     10, "", ""},
    {"box whose shifts cancel", BOX("1,1,1", "@1,0,0"), MOVE("1,2,3") "," MOVE("-1,-2,-3"),
     BOX("1,1,1", "0,0,0"), "", BOND_NONE, 0, false, FIVE, 10, "", ""},
    {"box slides beside one, both carried by turns of one sum", BOX("1,1,1", "0,0,0"),
     MOVE("0,0,0.5") "," TURN(Z_AXIS, "0.5") "," TURN(Z_AXIS, "0.2"), BOX("1,1,3", "@1,0,0"),
     TURN(Z_AXIS, "0.7"), BOND_NONE, 0, false, FIVE, 10, "", ""},
    {"piston in a bore, both carried by turns of one sum", CYLINDER("1", "3", "0,0,0"),
     TURN("1,0,0", "0.5") "," TURN("1,0,0", "0.2"), CAN("~1", "0.6", "0,0,0"),
     MOVE("0,0,0.5") "," TURN("1,0,0", "0.7"), BOND_NONE, 0, false, FIVE, 10, "", ""},
    /* carried by one motion in other words */
    {"boxes carried by one turn, its axis and rate negated", BOX("1,1,1", "0,0,0"),
     TURN("1,2,3", "7"), BOX("1,1,1", "@1,0,0"), TURN("-1,-2,-3", "-7"), BOND_NONE, 0, false,
     "1235", 10, "", ""},
    {"can carried in a bore, about another point of the line", CYLINDER("1", "3", "0,0,0"),
     TURN_AT("1,2,3", "7", "3,0,0"), CAN("~1", "0.6", "0,0,0"), TURN_AT("2,4,6", "7", "4,2,3"),
     BOND_NONE, 0, false, "1235", 10, "", ""},
    /* by formula */
    {"piston on a crank", CYLINDER("0.5", "3", "0,0,1"), PLACE, CAN("~0.5", "0.6", "0,0,0"),
     CRANK "," PLACE, BOND_NONE, 0, false, FIVE, 50, "", ""},
    {"piston on a crank, by table", CYLINDER("0.5", "3", "0,0,1"), PLACE,
     CAN("~0.5", "0.6", "0,0,0"), CRANK_TABLE "," PLACE, BOND_NONE, 0, false, FIVE, 50, "", ""},
    {"door that swings", FLOOR, PLACE, BOX("1,0.1,2", "0.6,0,@1"), SWING(Z_AXIS) "," SAME_PLACE,
     BOND_NONE, 0, false, FIVE, 50, "", ""},
    /* flat sides along each other */
    {"shaft of 32 sides in a closed tube", LATHE("op " RING), "", LATHE("p 32 ~1:-0.7 ~1:0.7"),
     TURN(Z_AXIS, "3"), BOND_NONE, 0, false, "1235", 200, "", ""},
    {"shaft of 32 sides in a closed tube, turned", LATHE("oi " RING), "",
     LATHE("i 32 ~1:-0.7 ~1:0.7"), TURN(INCLINED, "3") "," MOVE("-0.1,0.2,0.2"), BOND_NONE, 0,
     false, "1235", 200, "", ""},
    {"shaft of 32 sides in a can", CAN("1", "2", "0,0,0"), TUMBLE, LATHE("p 32 ~1:-0.5 ~1:0.5"),
     TURN(Z_AXIS, "3") "," MOVE("0,0,0.2"), BOND_PARENT, 0, false, "1235", 50, "", ""},
    {"can slides and spins in a bore of 64 sides", LATHE(TUBE), "", CAN("~1", "1.5", "0,0,0"),
     TURN(Z_AXIS, "5") "," MOVE("0,0,0.2"), BOND_NONE, 0, false, "1235", 50, "", ""},
    {"can whirls in a bore of 64 sides", LATHE(TUBE), "", CAN("0.8", "1.5", "0,0,0"),
     TURN(Z_AXIS, "20") "," PUT("~0.2,0,0") "," TURN(Z_AXIS, "2"), BOND_NONE, 0, false, "1235", 600,
     "", ""},
    {"balls of flat sides beside each other", LATHE(FOLIAGE), TURN(Z_AXIS, "1"), LATHE(FOLIAGE),
     PUT("@2,0,0"), BOND_NONE, 0, false, "1235", 200, "", ""},
    {NULL, "", "", "", "", BOND_NONE, 0, false, "", 0, "", ""}};
