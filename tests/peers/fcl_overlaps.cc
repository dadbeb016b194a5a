// SPDX-FileCopyrightText: The Impinge authors
// SPDX-License-Identifier: Apache-2.0

// Finds the shapes that overlap in given poses, by FCL. Reads from standard input: the number of
// shapes and each of them (box X Y Z | sphere R | cylinder R LENGTH | capsule R LENGTH | mesh
// POINTS TRIANGLES, their numbers); the number of pairs and each of them; the number of poses, and
// of each the matrices of all shapes, three rows of four. Prints for each pose the pairs that
// overlap, on one line.

#include <fcl/fcl.h>

#include <cstdio>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

using object = fcl::CollisionObjectd;

static double number()
{
    double x;
    if (!(std::cin >> x)) std::exit(1);
    return x;
}

static std::size_t count() { return static_cast<std::size_t>(number()); }

static std::shared_ptr<fcl::CollisionGeometryd> read_mesh()
{
    std::vector<fcl::Vector3d> points(count());
    std::vector<fcl::Triangle> triangles(count());
    for (auto &p : points)
        for (int k = 0; k < 3; ++k) p[k] = number();
    for (auto &t : triangles) {
        std::size_t a = count(), b = count(), c = count();
        t.set(a, b, c);
    }
    auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
    model->beginModel();
    model->addSubModel(points, triangles);
    model->endModel();
    return model;
}

static std::shared_ptr<fcl::CollisionGeometryd> read_shape()
{
    std::string kind;
    std::cin >> kind;
    if (kind == "mesh") return read_mesh();
    const double a = number();
    if (kind == "sphere") return std::make_shared<fcl::Sphered>(a);
    const double b = number();
    if (kind == "cylinder") return std::make_shared<fcl::Cylinderd>(a, b);
    if (kind == "capsule") return std::make_shared<fcl::Capsuled>(a, b);
    if (kind == "box") return std::make_shared<fcl::Boxd>(a, b, number());
    std::exit(1);
}

static void place(object &o)
{
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j) pose(i, j) = number();
    o.setTransform(pose);
    o.computeAABB();
}

static bool overlap(const object &a, const object &b)
{
    if (!a.getAABB().overlap(b.getAABB())) return false;
    const fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    return fcl::collide(&a, &b, request, result) > 0;
}

int main()
{
    std::vector<object> objects;
    for (std::size_t n = count(); n > 0; --n) objects.emplace_back(read_shape());
    std::vector<std::pair<std::size_t, std::size_t>> pairs(count());
    for (auto &pair : pairs) pair.first = count(), pair.second = count();
    for (std::size_t n = count(); n > 0; --n) {
        for (auto &o : objects) place(o);
        for (const auto &pair : pairs)
            if (overlap(objects[pair.first], objects[pair.second]))
                std::printf("%zu,%zu ", pair.first, pair.second);
        std::printf("\n");
    }
}
